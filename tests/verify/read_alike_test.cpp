// What the verifier reads is what others read: every text of a scene that it accepts is given to
// the importer as well, and both see the same triangles; and what others could read in another way
// is refused by name.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/scene_import.h"
#include "tests/assets/import_files.h"
#include "tests/support/holds.h"
#include "tests/support/random_geometry.h"
#include "tests/support/temp_folder.h"
#include "verify/certificate.h"
#include "verify/motion.h"
#include "verify/statement.h"

namespace foretouch::test {
namespace {

std::string whyNotScene(const std::string& text) {
  std::vector<verify::Triangle> triangles;
  return verify::readScene(text, triangles).what;
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(VerifyReads, NoSceneThatOthersReadInAnotherWay) {
  ASSERT_EQ(whyNotScene(kTriangle), "");
  EXPECT_EQ(whyNotScene("# a remark: \"x\" \\ y\r\no a\tb\n" + kTriangle), "");
  EXPECT_EQ(whyNotScene("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1/1 2//1 3/1/1\n"),
            "");
  const char* const twoWays[] = {
      "# remark\rv 9 9 9\n",  // some end lines at a carriage return
      "# remark\r\r\nv 9 9 9\n",
      "# remark \x0bv 9 9 9\n",  // or at other bytes
      "# remark \xc2\x85v 9 9 9\n",
      "# remark \xe2\x80\xa8v 9 9 9\n",
      "# remark \\\nv 9 9 9\n",  // or go on with the next one
      "# remark \\ \r\nv 9 9 9\n",
      " # remark\n",  // or skip lines that begin so
      " v 9 9 9\n",
      "v 1 1 1 2\n",  // w
      "v 1 1 1 2 2\n",
      "v 1 1 1 # 2\n",
      "v 1 1 1 0 0 0 0\n",
      "v 1 1 1 a b c\n",
      "v 1,5 1 1\n",
      "v 0x1 1 1\n",
      "v 1e400 1 1\n",
      "v nan 1 1\n",
      "f 1 2 3 # a face\n",
      "f 1 2 4\nv 1 1 1\n",  // of what comes later
      "f -1 -2 -3\n",
      "f 1/1 2/1 3/1\n",  // of what is not there
      "f 1/ 2/ 3/\n",
      "f 1/x 2 3\n",
      "f 1//1 2//1 3//1\n",
      "f 1 2 3 1\n",
      "l 1 2\n",
      "V 1 1 1\n",
      "curv 0 1 1 2\n",
      "call other.obj\n",
      "# no end of line",
  };
  for (const char* const text : twoWays) EXPECT_NE(whyNotScene(kTriangle + text), "") << text;
  EXPECT_NE(whyNotScene(std::string("# \0v 9 9 9\n", 11) + kTriangle), "");
  EXPECT_NE(whyNotScene("\xef\xbb\xbf" + kTriangle), "");
}

TEST(VerifyReads, NoAvatarThatOthersReadInAnotherWay) {
  const auto whyNot = [](const std::string& links) {
    std::vector<verify::Link> read;
    return verify::readAvatar(
               R"({"format":"foretouch-avatar","version":1,"links":[)" + links + "]}", read)
        .what;
  };
  const std::string a = R"({"name":"a","parent":null,"lss":[]})";
  EXPECT_EQ(whyNot(a + R"(,{"name":"b","parent":"a","lss":[],"note":"\u0061"})"), "");
  EXPECT_TRUE(holds(whyNot(a + R"(,{"name":"b","parent":"\u0061","lss":[]})"), "without escapes"));
  EXPECT_TRUE(holds(whyNot(a + R"(,{"name":"\u0062","parent":"a","lss":[]})"), "without escapes"));
  EXPECT_TRUE(holds(whyNot(a + R"(,{"name":"b","parent":0,"lss":[]})"), "without escapes"));
  EXPECT_TRUE(holds(whyNot(a + R"(,{"name":"b","parent":"a","lss":[],"l\u0073s":[]})"), "keys"));
  EXPECT_TRUE(holds(whyNot(a + "," + a), "names that differ"));
  std::string many = a;
  for (int i = 0; i < 4096; ++i) {
    many += R"(,{"name":"x)" + std::to_string(i) + R"(","parent":"a","lss":[]})";
  }
  EXPECT_TRUE(holds(whyNot(many), "at most 4096 links"));
}

TEST(VerifyReads, WorkIsBounded) {
  // A chain of many joints, asked at ever other instants.
  constexpr std::size_t kJoints = 4096;
  std::vector<verify::Link> links(kJoints);
  verify::Step step;
  for (std::size_t i = 0; i < kJoints; ++i) {
    links[i].parent = static_cast<int>(i) - 1;
    step.from.push_back({{0, 1, 0}, {1, 0, 0, 0}});
    step.to.push_back({{0, 1, 0}, {0.8, 0.6, 0, 0}});
  }
  verify::Motion motion(links, step, 200'000);
  ASSERT_EQ(motion.fault(), "");
  const auto askAll = [&] {
    for (std::int64_t index = 1; index < std::int64_t{1} << 20; index += 2) {
      static_cast<void>(motion.at(20, index, kJoints - 1));
    }
  };
  EXPECT_THROW(askAll(), std::exception);
  // Of one link at its head that is little.
  verify::Motion other(links, step, 200'000);
  for (std::int64_t index = 1; index < 10'000; index += 2) {
    static_cast<void>(other.at(20, index, 0));
  }
}

/// A text of triangles, as tools write them, and as they do not.
std::string drawScene(Random& random) {
  std::ostringstream text;
  const char* const separators[] = {" ", "  ", "\t", " \t "};
  const char* const ends[] = {"\n", "\r\n", " \n", "\t\r\n"};
  const auto separator = [&] { return separators[random.below(4)]; };
  const auto end = [&] { return ends[random.below(4)]; };
  const auto number = [&] {
    const double value = random.uniform(-20.0, 20.0);
    text.precision(random.chance(0.5) ? 17 : 3 + random.below(7));
    if (random.chance(0.2)) text << std::scientific;
    if (random.chance(0.2)) text << std::fixed;
    text << value << std::defaultfloat;
  };
  const int vertices = 3 + random.below(12);
  for (int i = 0; i < vertices; ++i) {
    if (random.chance(0.1)) text << "# v 1 2 3" << end();
    if (random.chance(0.1)) text << "o name" << i << end();
    if (random.chance(0.1)) text << end();
    text << "v";
    for (int k = 0; k < (random.chance(0.1) ? 6 : 3); ++k) {
      text << separator();
      number();
    }
    if (random.chance(0.02)) text << " 2";
    text << end();
  }
  text << "vt 0 0" << end() << "vn 0 0 1" << end();
  for (int i = 0; i < 1 + random.below(10); ++i) {
    text << "f";
    const int style = random.below(4);
    const int first = random.below(vertices);
    for (int k = 0; k < 3; ++k) {
      text << separator() << 1 + (first + k) % vertices;
      text << (style == 0 ? "" : style == 1 ? "/1" : style == 2 ? "//1" : "/1/1");
    }
    text << end();
  }
  return text.str();
}

TEST(VerifyReads, TheTrianglesThatTheImporterReads) {
  const TempFolder folder;
  int accepted = 0, numTriangles = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::string text = drawScene(random);
    std::vector<verify::Triangle> triangles;
    if (!verify::readScene(text, triangles).what.empty()) continue;
    ++accepted;
    SceneImportOptions options = withImporter();
    options.scale = 1.0;
    options.up = UpAxis::Y;
    const auto imported = importScene(folder.write("scene.obj", text), options);
    ASSERT_TRUE(imported.ok()) << text;
    const auto& other = imported.value().scene.triangles;
    ASSERT_EQ(other.size(), triangles.size()) << text;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double read = other[i].vertices[corner][static_cast<Eigen::Index>(axis)];
          const verify::Interval& own = triangles[i].corners[corner][axis];
          ASSERT_LE(own.lo, read) << text;
          ASSERT_GE(own.hi, read) << text;
        }
      }
      ++numTriangles;
    }
  }
  EXPECT_GT(accepted, 60);
  EXPECT_GT(numTriangles, 200);
}

}  // namespace
}  // namespace foretouch::test
