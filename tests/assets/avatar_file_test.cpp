#include "assets/avatar/avatar_file.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/assets/bvh_samples.h"

namespace foretouch {
namespace {

using test::edited;

std::string plainAvatar() {
  return "{\"format\": \"foretouch-avatar\", \"version\": 1,\n"
         " \"links\": [\n"
         "  {\"name\": \"Arm\", \"parent\": null, \"offset\": [0, 1, 0], \"rotation\": [1, 0, 0, "
         "0],\n"
         "   \"lss\": []},\n"
         "  {\"name\": \"ForeArm\", \"parent\": \"Arm\", \"offset\": [0, 0.27, 0],\n"
         "   \"lss\": [{\"a\": [0, 0, 0], \"b\": [0, 0.25, 0], \"radius\": 0.045}],\n"
         "   \"mesh\": {\"file\": \"body.glb\", \"node\": \"N\"}}\n"
         " ]}\n";
}

void expectRefusal(const std::string& text, ErrorCode code, std::int64_t line, std::int64_t index,
                   const std::string& about) {
  const auto avatar = parseAvatar(text, "bad.json");
  ASSERT_FALSE(avatar.ok()) << about;
  const Error& error = avatar.error();
  EXPECT_STREQ(toString(error.code), toString(code)) << describe(error);
  EXPECT_EQ(error.line, line) << describe(error);
  EXPECT_EQ(error.index, index) << describe(error);
  EXPECT_EQ(error.file, "bad.json");
  EXPECT_NE(error.message.find(about), std::string::npos) << describe(error);
}

void expectRefusal(const std::string& from, const std::string& to, ErrorCode code,
                   std::int64_t line, std::int64_t index, const std::string& about) {
  expectRefusal(edited(plainAvatar(), from, to), code, line, index, about);
}

TEST(ParseAvatar, ReadsEveryField) {
  const auto avatar = parseAvatar(plainAvatar(), "good.json");
  ASSERT_TRUE(avatar.ok()) << describe(avatar.error());
  const Skeleton& skeleton = avatar.value().skeleton();
  ASSERT_EQ(avatar.value().numLinks(), 2);
  EXPECT_EQ(skeleton.name(1), "ForeArm");
  EXPECT_EQ(skeleton.parent(0), kNoParent);
  EXPECT_EQ(skeleton.parent(1), 0);
  EXPECT_EQ(skeleton.restOffset(1), Eigen::Vector3d(0, 0.27, 0));
  EXPECT_TRUE(avatar.value().lss(0).empty());
  ASSERT_EQ(avatar.value().lss(1).size(), 1u);
  EXPECT_EQ(avatar.value().lss(1)[0].b, Eigen::Vector3d(0, 0.25, 0));
  EXPECT_EQ(avatar.value().lss(1)[0].radius, 0.045);
  EXPECT_EQ(avatar.value().mesh(1).file, "body.glb");
  EXPECT_EQ(avatar.value().mesh(1).node, "N");
  EXPECT_TRUE(avatar.value().mesh(0).file.empty());
}

TEST(ParseAvatar, OrderOfKeysAndBlanksDoNotMatter) {
  const auto avatar = parseAvatar(
      "{\"links\":[{\"lss\":[{\"radius\":1,\"b\":[1,2,3],\"a\":[0,0,0]}],\"rotation\":[0,1,0,0],"
      "\"offset\":[1e0,2E+0,3.0],\"parent\":null,\"name\":\"a\"}],\"version\":1.0,"
      "\"format\":\"foretouch-avatar\"}",
      "t");
  ASSERT_TRUE(avatar.ok()) << describe(avatar.error());
  EXPECT_EQ(avatar.value().skeleton().restOffset(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(avatar.value().skeleton().restRotation(0).x(), 1.0);
}

TEST(ParseAvatar, RefusesUnknownAndRepeatedAndMissingKeys) {
  expectRefusal("\"version\": 1", "\"version\": 1, \"author\": \"x\"", ErrorCode::UnknownName, 1,
                -1, "'author'; expected one of format, version, links");
  expectRefusal("\"mesh\": {", "\"colour\": {", ErrorCode::UnknownName, 7, 1, "link 1 'ForeArm'");
  expectRefusal("\"radius\"", "\"r\"", ErrorCode::UnknownName, 6, 1, "a, b, radius");
  expectRefusal("\"node\"", "\"nod\"", ErrorCode::UnknownName, 7, 1, "file, node");
  expectRefusal("\"version\": 1", "\"version\": 1, \"version\": 1", ErrorCode::DuplicateName, 1, -1,
                "'version' appears twice");
  expectRefusal("\"radius\": 0.045", "\"radius\": 1, \"radius\": 1", ErrorCode::DuplicateName, 6, 1,
                "twice");
  expectRefusal("\"version\": 1,", "", ErrorCode::Syntax, 8, -1, "'version' is missing");
  expectRefusal(" \"parent\": null,", "", ErrorCode::Syntax, 4, 0, "'parent' is missing");
  expectRefusal(", \"radius\": 0.045", "", ErrorCode::Syntax, 6, 1, "'radius' is missing");
  expectRefusal(", \"node\": \"N\"", "", ErrorCode::Syntax, 7, 1, "'node' is missing");
  expectRefusal("{}", ErrorCode::Syntax, 1, -1, "'format' is missing");
}

TEST(ParseAvatar, RefusesWrongTypesAndSaysWhatWasExpected) {
  expectRefusal("\"foretouch-avatar\"", "\"urdf\"", ErrorCode::Syntax, 1, -1, "found 'urdf'");
  expectRefusal("\"version\": 1", "\"version\": 2", ErrorCode::Syntax, 1, -1, "the only version");
  expectRefusal("\"version\": 1", "\"version\": \"1\"", ErrorCode::Syntax, 1, -1, "found a text");
  expectRefusal("\"Arm\", \"parent\": null", "\"Arm\", \"parent\": 0", ErrorCode::Syntax, 3, 0,
                "earlier link, or null");
  expectRefusal("\"name\": \"Arm\"", "\"name\": null", ErrorCode::Syntax, 3, 0, "a name");
  expectRefusal("[0, 1, 0],", "[0, 1],", ErrorCode::Syntax, 3, 0,
                "3 numbers for \"offset\", found 2");
  expectRefusal("[0, 1, 0],", "[0, 1, 0, 0],", ErrorCode::Syntax, 3, 0, "found more");
  expectRefusal("[0, 1, 0],", "[0, \"1\", 0],", ErrorCode::Syntax, 3, 0, "found a text");
  expectRefusal("[0, 1, 0],", "[0, null, 0],", ErrorCode::Syntax, 3, 0, "found null");
  expectRefusal("[0, 1, 0],", "[0, [1], 0],", ErrorCode::Syntax, 3, 0, "an array in it");
  expectRefusal("[0, 1, 0],", "{},", ErrorCode::Syntax, 3, 0, "found an object");
  expectRefusal("[1, 0, 0, 0]", "[1, 0, 0]", ErrorCode::Syntax, 3, 0, "4 numbers (w, x, y, z)");
  expectRefusal("\"lss\": []", "\"lss\": {}", ErrorCode::Syntax, 4, 0, "array of LSS");
  expectRefusal("\"lss\": []", "\"lss\": [[]]", ErrorCode::Syntax, 4, 0,
                "an object that is an LSS");
  expectRefusal("\"lss\": []", "\"lss\": [1]", ErrorCode::Syntax, 4, 0, "an object that is an LSS");
  expectRefusal("0.045", "true", ErrorCode::Syntax, 6, 1, "a number for \"radius\"");
  expectRefusal("\"body.glb\"", "null", ErrorCode::Syntax, 7, 1, "a text for \"file\"");
  expectRefusal("\"body.glb\"", "\"\"", ErrorCode::Empty, 7, 1, "empty text");
  expectRefusal("[]", ErrorCode::Syntax, 1, -1, "one avatar object");
  expectRefusal("null", ErrorCode::Syntax, 1, -1, "one avatar object");
  expectRefusal("{\"links\": [7]}", ErrorCode::Syntax, 1, -1, "an object that is a link");
}

TEST(ParseAvatar, RefusesNumbersThatAreNoneAndOutOfRange) {
  expectRefusal("0.045", "1e999", ErrorCode::NonFinite, 6, 1, "too large for a double");
  expectRefusal("0.045", "NaN", ErrorCode::Syntax, 6, 1, "broken JSON");
  expectRefusal("0.045", "-0.045", ErrorCode::NonFinite, 5, 1, "negative radius");
  expectRefusal("0.045", "1e8", ErrorCode::OutOfRange, 5, 1, "beyond 1e7");
  expectRefusal("[0, 0.27, 0]", "[0, 2e7, 0]", ErrorCode::OutOfRange, 5, 1, "rest offset");
  expectRefusal("[1, 0, 0, 0]", "[0.9, 0, 0, 0]", ErrorCode::OutOfRange, 3, 0, "norm");
}

TEST(ParseAvatar, RefusesHierarchiesThatAreNone) {
  expectRefusal("\"parent\": \"Arm\"", "\"parent\": \"Leg\"", ErrorCode::BadHierarchy, 5, 1,
                "parents come before children");
  expectRefusal("\"parent\": \"Arm\"", "\"parent\": \"ForeArm\"", ErrorCode::BadHierarchy, 5, 1,
                "ForeArm");
  expectRefusal("\"name\": \"ForeArm\"", "\"name\": \"Arm\"", ErrorCode::DuplicateName, 5, 1,
                "unique");
  expectRefusal("\"name\": \"ForeArm\"", "\"name\": \"\"", ErrorCode::Empty, 5, 1, "is empty");
  expectRefusal("\"name\": \"ForeArm\"", "\"name\": \"a\\u0007\"", ErrorCode::Syntax, 5, 1,
                "control");
  expectRefusal("{\"format\": \"foretouch-avatar\", \"version\": 1, \"links\": []}",
                ErrorCode::Empty, -1, -1, "at least one joint");
}

TEST(ParseAvatar, RefusesBrokenJsonAndNamesTheLine) {
  expectRefusal("", ErrorCode::Syntax, 1, -1, "broken JSON");
  expectRefusal("\"links\": [", "\"links\": (", ErrorCode::Syntax, 2, -1, "broken JSON");
  expectRefusal("\"lss\": []}", "\"lss\": []", ErrorCode::Syntax, 5, 0, "broken JSON");
  expectRefusal("\"N\"", "\"N", ErrorCode::Syntax, 7, 1, "broken JSON");
  expectRefusal("\"N\"", "\"\xff\"", ErrorCode::Syntax, 7, 1, "broken JSON");
  expectRefusal(" ]}", " ]} x", ErrorCode::Syntax, 8, -1, "broken JSON");
  expectRefusal(plainAvatar() + plainAvatar(), ErrorCode::Syntax, 9, -1, "broken JSON");
}

TEST(ParseAvatar, HostileNestingEndsAtOnce) {
  const std::string deep(1000000, '[');
  expectRefusal(deep, ErrorCode::Syntax, 1, -1, "one avatar object");
  expectRefusal("[0, 1, 0],", deep, ErrorCode::Syntax, 3, 0, "array in it");
  expectRefusal("\"links\": [", "\"links\": " + deep, ErrorCode::Syntax, 2, -1, "a link");
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"mesh\":";
  expectRefusal("{\"file\"", objects + "{\"file\"", ErrorCode::UnknownName, 7, 1, "'mesh'");
}

TEST(ParseAvatar, RefusesMoreLinksAndLssThanTheLimits) {
  const std::string head = "{\"format\":\"foretouch-avatar\",\"version\":1,\"links\":[";
  std::string links;
  for (int i = 0; i <= kMaxJoints; ++i) {
    links += (i == 0 ? "" : ",") + std::string("{\"name\":\"n") + std::to_string(i) +
             "\",\"parent\":null,\"offset\":[0,0,0],\"lss\":[]}";
  }
  expectRefusal(head + links + "]}", ErrorCode::LimitExceeded, 1, -1, "4096 links");
  std::string lss;
  for (std::size_t i = 0; i <= kMaxLssPerLink; ++i) {
    lss += (i == 0 ? "" : ",") + std::string("{\"a\":[0,0,0],\"b\":[0,0,0],\"radius\":1}");
  }
  expectRefusal("\"lss\": []", "\"lss\": [" + lss + "]", ErrorCode::LimitExceeded, 4, 0,
                "4096 LSS");
}

// Bit for bit, so -0 and the last digit count: == on doubles is not enough.
bool sameBits(const Eigen::Ref<const Eigen::VectorXd>& a,
              const Eigen::Ref<const Eigen::VectorXd>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

void expectSameBits(const Avatar& a, const Avatar& b) {
  ASSERT_EQ(a.numLinks(), b.numLinks());
  for (LinkId i = 0; i < a.numLinks(); ++i) {
    EXPECT_EQ(a.skeleton().name(i), b.skeleton().name(i));
    EXPECT_EQ(a.skeleton().parent(i), b.skeleton().parent(i));
    EXPECT_TRUE(sameBits(a.skeleton().restOffset(i), b.skeleton().restOffset(i)));
    EXPECT_TRUE(
        sameBits(a.skeleton().restRotation(i).coeffs(), b.skeleton().restRotation(i).coeffs()));
    EXPECT_EQ(a.mesh(i).file, b.mesh(i).file);
    EXPECT_EQ(a.mesh(i).node, b.mesh(i).node);
    ASSERT_EQ(a.lss(i).size(), b.lss(i).size());
    for (std::size_t k = 0; k < a.lss(i).size(); ++k) {
      EXPECT_TRUE(sameBits(a.lss(i)[k].a, b.lss(i)[k].a));
      EXPECT_TRUE(sameBits(a.lss(i)[k].b, b.lss(i)[k].b));
      EXPECT_EQ(a.lss(i)[k].radius, b.lss(i)[k].radius);
    }
  }
}

/// Doubles of every size within the limits, zeros of both signs among them.
double anyCoordinate(std::mt19937_64& random) {
  const std::uint64_t kind = random() % 8;
  const double sign = random() % 2 == 0 ? 1.0 : -1.0;
  if (kind == 0) return sign * 0.0;
  if (kind == 1) return sign * static_cast<double>(random() % 1000);
  if (kind == 2) return sign * 5e-324;
  const double exponent = std::uniform_real_distribution<>(-300, 6.99)(random);
  return sign * std::pow(10.0, kind < 6 ? std::fmod(exponent, 7.0) : exponent);
}

Avatar randomAvatar(int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  const auto point = [&] {
    return Eigen::Vector3d(anyCoordinate(random), anyCoordinate(random), anyCoordinate(random));
  };
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  std::vector<MeshReference> meshes;
  const int links = 1 + static_cast<int>(random() % 6);
  for (int i = 0; i < links; ++i) {
    RawJoint joint;
    joint.name = "n\"\\\xc3\xa0 " + std::to_string(i);
    joint.parent = static_cast<JointId>(random() % static_cast<unsigned>(i + 1)) - 1;
    joint.offset = point();
    if (random() % 3 != 0) {
      std::normal_distribution<> normal;
      joint.rotation = Quaternion(normal(random), normal(random), normal(random), normal(random));
      joint.rotation.normalize();
    } else if (random() % 2 == 0) {
      joint.rotation = Quaternion(1.0, -0.0, 0.0, -0.0);
    }
    raw.joints.push_back(joint);
    lss.emplace_back();
    for (std::uint64_t k = random() % 3 + (i == 0 ? 1 : 0); k > 0; --k) {
      lss.back().push_back({point(), point(), std::abs(anyCoordinate(random))});
    }
    meshes.push_back(random() % 2 == 0 ? MeshReference{}
                                       : MeshReference{"a/b \xc3\xa0.glb", "n\"/"});
  }
  return Avatar::build(Skeleton::build(raw).value(), lss, meshes).value();
}

TEST(FormatAvatar, ReadsBackBitForBit) {
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Avatar avatar = randomAvatar(seed);
    const std::string text = formatAvatar(avatar);
    const auto again = parseAvatar(text, "t");
    ASSERT_TRUE(again.ok()) << describe(again.error()) << text;
    expectSameBits(avatar, again.value());
    EXPECT_EQ(formatAvatar(again.value()), text);
  }
}

TEST(FormatAvatar, IsTheDocumentedText) {
  const auto avatar = parseAvatar(plainAvatar(), "t");
  ASSERT_TRUE(avatar.ok());
  EXPECT_EQ(formatAvatar(avatar.value()),
            "{\"format\": \"foretouch-avatar\", \"version\": 1,\n"
            " \"links\": [\n"
            "  {\"name\": \"Arm\", \"parent\": null, \"offset\": [0, 1, 0],\n"
            "   \"lss\": []},\n"
            "  {\"name\": \"ForeArm\", \"parent\": \"Arm\", \"offset\": [0, 0.27, 0],\n"
            "   \"lss\": [{\"a\": [0, 0, 0], \"b\": [0, 0.25, 0], \"radius\": 0.045}],\n"
            "   \"mesh\": {\"file\": \"body.glb\", \"node\": \"N\"}}\n"
            " ]}\n");
}

TEST(WriteAvatarFile, WritesWhatReadAvatarFileReads) {
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("foretouch-avatar-" + std::to_string(::getpid()) + ".json"))
                               .string();
  const Avatar avatar = randomAvatar(7);
  ASSERT_TRUE(writeAvatarFile(avatar, path).ok());
  const auto again = readAvatarFile(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(again.ok()) << describe(again.error());
  expectSameBits(avatar, again.value());
}

TEST(WriteAvatarFile, SaysWhereItCouldNotWrite) {
  const auto done = writeAvatarFile(randomAvatar(1), "/nonexistent/folder/a.json");
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, ErrorCode::FileUnwritable);
  EXPECT_EQ(readAvatarFile("/nonexistent/folder/a.json").error().code, ErrorCode::FileNotFound);
}

}  // namespace
}  // namespace foretouch
