// Xsens' MVNX, made in its own dialect: segments must come out where the file says that they are.
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/humanoid_rest.h"
#include "assets/clip/clip_file.h"
#include "tests/support/holds.h"
#include "tests/support/random_geometry.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

const std::vector<std::pair<std::string, std::string>> kCarried{
    {"L5", "Pelvis"}, {"T8", "L5"}, {"RightUpperArm", "T8"}, {"Head", "T8"}};
// In another order than that of what carries what.
const std::vector<std::string> kSegments{"Pelvis", "Head", "L5", "T8", "RightUpperArm"};

std::string numbers(const std::vector<double>& all) {
  std::string text;
  for (const double n : all) {
    char digits[40];
    std::snprintf(digits, sizeof digits, text.empty() ? "%.9f" : " %.9f", n);
    text += digits;
  }
  return text;
}

struct Frame {
  std::vector<RigidPose> places;
  [[nodiscard]] std::string text(const std::string& head) const {
    std::vector<double> turns, at;
    for (const RigidPose& place : places) {
      const Quaternion& q = place.rotation;
      turns.insert(turns.end(), {q.w(), q.x(), q.y(), q.z()});
      at.insert(at.end(), {place.translation.x(), place.translation.y(), place.translation.z()});
    }
    return "<frame " + head + ">\n<orientation>" + numbers(turns) + "</orientation>\n<position>" +
           numbers(at) + "</position>\n</frame>\n";
  }
};

Frame randomFrame(Random& random) {
  Frame frame;
  for (std::size_t i = 0; i < kSegments.size(); ++i)
    frame.places.push_back({random.rotation(), random.inBox(1)});
  return frame;
}

std::string mvnx(const std::string& frames, const std::string& segments = "") {
  std::string all, joints;
  for (std::size_t i = 0; i < kSegments.size(); ++i) {
    all += "<segment id=\"" + std::to_string(i + 1) + "\" label=\"" + kSegments[i] +
           "\"><points/></segment>\n";
  }
  for (const auto& [carried, by] : kCarried) {
    joints += "<joint label=\"j" + carried + "\"><connector1>" + by + "/j" + carried +
              "</connector1><connector2>" + carried + "/j" + carried + "</connector2></joint>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<mvnx version=\"4\">\n<mvn "
         "version=\"2021.2\" build=\"1\"/>\n"
         "<subject label=\"P\" frameRate=\"60\" segmentCount=\"5\">\n<segments>\n" +
         (segments.empty() ? all : segments) + "</segments>\n<sensors/>\n<joints>\n" + joints +
         "</joints>\n<frames segmentCount=\"5\">\n" + frames + "</frames>\n</subject>\n</mvnx>\n";
}

class Mvnx : public testing::Test {
 protected:
  Result<ClipFile> read(const std::string& text) {
    ClipFileOptions options;
    options.import.importer = FORETOUCH_TEST_IMPORTER;
    return readClipFile(folder_.write("a.mvnx", text), options);
  }
  TempFolder folder_;
};

TEST_F(Mvnx, PutsSegmentsWhereTheFileSays) {
  Random random(1);
  const Frame rest = randomFrame(random);
  std::vector<Frame> frames;
  std::string text = randomFrame(random).text("type=\"identity\" index=\"\"") +
                     rest.text("type=\"tpose\" time=\"0\" index=\"\"");
  for (int k = 0; k < 4; ++k) {
    frames.push_back(randomFrame(random));
    text += frames.back().text("type=\"normal\" time=\"" + std::to_string(17 * k) + "\" index=\"" +
                               std::to_string(k) + "\"");
  }
  const auto file = read(mvnx(text));
  ASSERT_TRUE(file.ok()) << describe(file.error());
  const Clip& clip = file.value().clip;
  EXPECT_TRUE(file.value().isUpright);
  EXPECT_NEAR(clip.frameTimeS, 1.0 / 60.0, 1e-12);
  ASSERT_EQ(clip.frames.size(), frames.size());
  const auto expectAt = [&](const Frame& frame, const Pose& pose) {
    const auto places = placesIn(clip.skeleton, pose);
    for (std::size_t i = 0; i < kSegments.size(); ++i) {
      const auto joint = static_cast<std::size_t>(clip.skeleton.find(kSegments[i]).value());
      const Vector3d p = frame.places[i].translation;
      EXPECT_LT((places[joint].translation - Vector3d(p.x(), p.z(), -p.y())).norm(), 1e-7)
          << kSegments[i];
      const Vector3d x = frame.places[i].rotation * Vector3d::UnitX();
      EXPECT_LT(
          (places[joint].rotation * Vector3d::UnitX() - Vector3d(x.x(), x.z(), -x.y())).norm(),
          1e-7);
    }
  };
  expectAt(rest, restPose(clip.skeleton));
  for (std::size_t k = 0; k < frames.size(); ++k) expectAt(frames[k], clip.frames[k]);
}

TEST_F(Mvnx, NamesWhatIsWrong) {
  Random random(2);
  const auto normal = [&](int index) {
    return randomFrame(random).text("type=\"normal\" index=\"" + std::to_string(index) + "\"");
  };
  const std::string good = mvnx(normal(0) + normal(1));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  const auto unposed = read(good);
  ASSERT_TRUE(unposed.ok()) << describe(unposed.error());
  ASSERT_FALSE(unposed.value().clip.notes.empty());
  EXPECT_TRUE(holds(unposed.value().clip.notes[0], "it has no T-pose"))
      << unposed.value().clip.notes[0];
  const std::vector<std::pair<std::string, std::string>> cases{
      {"not xml", "a.mvnx"},
      {"<mvn></mvn>", "expected a <mvnx> element, found <mvn>"},
      {with("<subject label", "<object label"), "a.mvnx"},
      {with("frameRate=\"60\"", "frameRate=\"0\""),
       "line 4: expected a frameRate above 0, found '0'"},
      {with("label=\"L5\"", "label=\"Head\""), "line 8: two segments are called 'Head'"},
      {with("<connector1>L5/jT8", "<connector1>L4/jT8"), "'L4/jT8' is at no segment"},
      {with("<connector2>T8/jT8", "<connector2>L5/jT8"), "segment 'L5' hangs on two joints"},
      {with("<connector1>Pelvis/jL5", "<connector1>T8/jL5"), "its joints form a cycle"},
      {with("<position>", "<position>1 "), "expected 15 numbers in <position>, found 16"},
      {with("<position>", "<position>x"), "expected finite numbers in <position>"},
      {with("<orientation>", "<orientation>9"), "'Pelvis' is turned by no unit quaternion"},
      {with("index=\"1\"", "index=\"0\""), "expected an index above the one before"},
      {mvnx(normal(0)), "expected at least two frames of the type 'normal'"},
      {mvnx(""), "expected frames of the type 'normal'"},
      {mvnx(normal(0), "<segment/>"), "expected a label"},
  };
  for (const auto& [text, expected] : cases) {
    const auto file = read(text);
    ASSERT_FALSE(file.ok()) << expected;
    EXPECT_TRUE(holds(describe(file.error()), expected)) << describe(file.error());
  }
  for (std::size_t n = 0; n < good.size(); n += 97) EXPECT_FALSE(read(good.substr(0, n)).ok());
  const auto gap = read(mvnx(normal(0) + normal(1) + normal(4)));
  ASSERT_TRUE(gap.ok());
  EXPECT_EQ(gap.value().clip.frames.size(), 5u);
  ASSERT_EQ(gap.value().clip.gaps.size(), 1u);
  EXPECT_EQ(gap.value().clip.gaps[0].first, 2);
  EXPECT_EQ(gap.value().clip.gaps[0].last, 3);
  EXPECT_EQ(gap.value().clip.gaps[0].joint, kNoParent);
  EXPECT_TRUE(holds(gap.value().clip.notes[1], "frames are missing")) << gap.value().clip.notes[1];
}

}  // namespace
}  // namespace foretouch::test
