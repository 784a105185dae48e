// FBX files against a second reader that shares no code with ours, three.js under node: where every
// joint stands at rest, and at ten instants of the animation, between its keys too.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "articulated/motion.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/fbx_writer.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"
#include "tests/support/random_geometry.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Positions = std::map<std::string, Vector3d>;

constexpr double kNear = 1e-5;  // metres
constexpr int kInstants = 10;

/// What the second reader says, in metres.
struct Reading {
  Positions rest;
  std::vector<Positions> instants;
};

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

/// The standard output of a command; nothing if it fails.
std::optional<std::string> outputOf(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) {
    text.append(part.data(), n);
  }
  if (pclose(pipe) != 0) return std::nullopt;
  return text;
}

Positions positionsIn(const nlohmann::json& nodes, double metresPerUnit) {
  Positions positions;
  for (const auto& [name, p] : nodes.items()) {
    positions[name] = metresPerUnit * Vector3d(p[0], p[1], p[2]);
  }
  return positions;
}

/// Of one or two files: the second one's animation moves the first one's nodes.
std::optional<Reading> readSecond(const std::string& file, double durationS,
                                  const std::string& animation = "") {
  std::string command = "node " + quoted(FORETOUCH_SECOND_READER) + " " + quoted(FORETOUCH_THREE) +
                        " " + quoted(file) + " " + quoted(animation);
  for (int i = 0; i < kInstants; ++i) {
    command += " " + std::to_string(durationS * i / (kInstants - 1));
  }
  const auto text = outputOf(command + " 2>/dev/null");
  if (!text || text->find('{') == std::string::npos) return std::nullopt;
  // three.js may greet us first.
  const nlohmann::json said = nlohmann::json::parse(text->substr(text->find('{')));
  const double metresPerUnit = said["unit"].get<double>() / 100.0;
  Reading reading{positionsIn(said["rest"], metresPerUnit), {}};
  for (const auto& instant : said["instants"]) {
    reading.instants.push_back(positionsIn(instant, metresPerUnit));
  }
  return reading;
}

Positions positionsOf(const Skeleton& skeleton, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  Positions positions;
  for (std::size_t j = 0; j < states.size(); ++j) {
    positions[skeleton.name(static_cast<JointId>(j))] = states[j].p_WL;
  }
  return positions;
}

/// Returns how many nodes both know.
int expectSame(const Positions& ours, const Positions& theirs, const std::string& what) {
  int same = 0;
  for (const auto& [name, p] : theirs) {
    const auto found = ours.find(name);
    if (found == ours.end()) continue;
    ++same;
    EXPECT_LT((found->second - p).norm(), kNear)
        << what << ", " << name << ": " << found->second.transpose() << " and " << p.transpose();
  }
  return same;
}

class SecondReader : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(fs::path(FORETOUCH_THREE) / "package.json") ||
        !outputOf("node --version 2>/dev/null")) {
      GTEST_SKIP() << "node or three.js absent: " << FORETOUCH_THREE;
    }
  }
  static Model read(const std::string& path) {
    auto model = importModel(path, withModelImporter());
    if (model.ok()) return std::move(model).value();
    ADD_FAILURE() << describe(model.error());
    return {};
  }
  /// The file's own nodes, in its own animation.
  static void expectSameMotion(const std::string& path, int leastJoints) {
    const Model model = read(path);
    ASSERT_FALSE(model.animations.empty()) << path;
    const double durationS = model.animations[0].durationS;
    const auto second = readSecond(path, durationS);
    ASSERT_TRUE(second) << path;
    const auto clip = clipFromModel(model, {"", (kInstants - 1) / durationS});
    ASSERT_TRUE(clip.ok()) << path;
    ASSERT_EQ(second->instants.size(), std::size_t{kInstants}) << path;
    for (std::size_t i = 0; i < second->instants.size(); ++i) {
      const int same = expectSame(positionsOf(clip.value().skeleton, clip.value().frames[i]),
                                  second->instants[i], path + ", instant " + std::to_string(i));
      EXPECT_GE(same, leastJoints) << path;
    }
  }
  static void expectSameRest(const std::string& path, int leastNodes) {
    const Model model = read(path);
    const auto second = readSecond(path, 1.0);
    ASSERT_TRUE(second) << path;
    Positions ours;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      ours.emplace(model.nodes[i].name, toWorld(model, static_cast<std::int32_t>(i)).translation);
    }
    EXPECT_GE(expectSame(ours, second->rest, path), leastNodes) << path;
  }
  /// One file's body, moved by the other's animation.
  static void expectSameTogether(const std::string& body, const std::string& animation,
                                 int leastJoints) {
    const auto made = avatarFromModel(read(body));
    ASSERT_TRUE(made.ok()) << body;
    const Skeleton& skeleton = made.value().avatar.skeleton();
    const Model motion = read(animation);
    ASSERT_FALSE(motion.animations.empty()) << animation;
    const double durationS = motion.animations[0].durationS;
    const auto clip = clipFromModel(motion, {"", (kInstants - 1) / durationS});
    ASSERT_TRUE(clip.ok()) << animation;
    const auto match = matchJoints(skeleton, clip.value().skeleton);
    ASSERT_TRUE(match.ok()) << animation;
    const auto second = readSecond(body, durationS, animation);
    ASSERT_TRUE(second) << body;
    ASSERT_EQ(second->instants.size(), std::size_t{kInstants}) << animation;
    for (std::size_t i = 0; i < second->instants.size(); ++i) {
      const Pose pose = poseOfAvatar(skeleton, clip.value(), match.value(), i);
      const int same = expectSame(positionsOf(skeleton, pose), second->instants[i],
                                  body + ", instant " + std::to_string(i));
      EXPECT_GE(same, leastJoints) << body;
    }
  }

  TempFolder folder_;
};

/// Five bones in a row, turned before and after; the last one carries a triangle.
FbxFile randomArm(std::uint64_t seed) {
  Random random(seed);
  FbxFile file;
  file.unitScaleFactor = seed % 3 == 0 ? 1.0 : seed % 3 == 1 ? 2.54 : 100.0;
  file.upAxis = seed % 2 == 0 ? 1 : 2;
  for (int i = 0; i < 5; ++i) {
    FbxNode node;
    node.name = "bone" + std::to_string(i);
    node.parent = i - 1;
    node.translation = random.inBox(20) / file.unitScaleFactor;
    node.rotation = random.inBox(170);
    node.rotationOrder = random.below(6);
    node.preRotation = random.inBox(170);
    if (i % 2 == 1) node.postRotation = random.inBox(170);
    file.nodes.push_back(node);
  }
  file.nodes.back().hasMesh = true;
  return file;
}

FbxFile moved(FbxFile file, std::uint64_t seed) {
  Random random(seed);
  file.stopS = 1.0;
  for (FbxNode& node : file.nodes) {
    for (FbxCurve& curve : node.rotations) {
      for (const double timeS : {0.0, 0.5, 1.0}) curve.emplace_back(timeS, random.uniform(-90, 90));
    }
  }
  for (FbxCurve& curve : file.nodes[0].translations) {
    for (const double timeS : {0.0, 1.0}) {
      curve.emplace_back(timeS, random.uniform(-90, 90) / file.unitScaleFactor);
    }
  }
  return file;
}

TEST_F(SecondReader, AgreesOnFilesOfEveryUnitAxisAndOrderOfRotation) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const std::string path = folder_.write("arm.fbx", moved(randomArm(seed), seed).text());
    expectSameRest(path, 5);
    expectSameMotion(path, 5);
  }
}

TEST_F(SecondReader, AgreesOnABodyAndAnAnimationInFilesOfTheirOwn) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    FbxFile animation = moved(randomArm(seed), seed);
    animation.nodes.back().hasMesh = false;
    expectSameTogether(folder_.write("body.fbx", randomArm(seed).text()),
                       folder_.write("animation.fbx", animation.text()), 5);
  }
}

TEST_F(SecondReader, AgreesOnARealBodyAndARealAnimation) {
  FORETOUCH_REQUIRE_SHARED(body, "avatars/pab_arnaud.fbx");
  FORETOUCH_REQUIRE_SHARED(run, "avatars/pab_run.fbx");
  expectSameRest(*body, 50);
  expectSameMotion(*run, 50);
}

/// FORETOUCH_FBX_FILES: more files to judge, separated by colons.
TEST_F(SecondReader, AgreesOnFilesThatSomebodyNames) {
  const char* const named = std::getenv("FORETOUCH_FBX_FILES");
  if (named == nullptr) GTEST_SKIP() << "no file is named in FORETOUCH_FBX_FILES";
  std::istringstream list(named);
  for (std::string path; std::getline(list, path, ':');) {
    expectSameRest(path, 1);
    if (!read(path).animations.empty()) expectSameMotion(path, 1);
  }
}

}  // namespace
}  // namespace foretouch::test
