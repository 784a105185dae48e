// Real recordings from a dozen sources: all are read, and all give an avatar. The counts are those
// that an independent parser found.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_reader.h"
#include "lss/fit.h"
#include "tests/support/shared_data.h"

namespace foretouch {
namespace {

struct Recording {
  const char* file;
  int joints;
  std::size_t frames;
  double rateHz;
  bool isHuman;
};

/// The case's name, for test listings.
void PrintTo(const Recording& tested, std::ostream* out) {
  *out << tested.file;
}

const std::vector<Recording>& recordings() {
  static const std::vector<Recording> list = {
      {"cmu_01_01_playground_jumps.bvh", 31, 2752, 120, true},
      {"cmu_jumping_jacks.bvh", 31, 125, 30.003, true},
      {"cmu_cgspeed_walk_crlf.bvh", 31, 344, 120, true},
      {"bandai1_kick_normal_001.bvh", 22, 358, 30, true},
      {"bandai1_punch_normal_001.bvh", 22, 224, 30, true},
      {"bandai1_slash_normal_001.bvh", 22, 402, 30, true},
      {"bandai1_dash_normal_001.bvh", 22, 20, 30, true},
      {"bandai1_dance-short_normal_001.bvh", 22, 1901, 30, true},
      {"fair_jumping.bvh", 27, 654, 119.875, true},
      {"fair_dab.bvh", 27, 339, 30, true},
      {"freebvh_mixamorig.bvh", 55, 69, 30, true},
      {"mocapbank.bvh", 19, 455, 30, true},
      {"pybvh_per_joint_orders.bvh", 24, 75, 30, true},
      {"pybvh_YXZ_crlf.bvh", 23, 61, 120.005, true},
      {"pybvh_fingers_orders.bvh", 60, 100, 120.005, true},
      {"odd_rotation_first_root.bvh", 4, 4, 25, false},
      {"makehuman_zombieWalk1.bvh", 75, 31, 24, true},
      {"odd_makehuman_benchmark_1frame.bvh", 163, 1, 24, true},
      {"odd_sinusoidal_no_endsite.bvh", 4, 120, 60, false},
      {"odd_\xc3\xa0n\xc3\xaem.bvh", 5, 2, 30, false},
  };
  return list;
}

class SharedClip : public ::testing::TestWithParam<Recording> {
 protected:
  void SetUp() override {
    FORETOUCH_REQUIRE_SHARED(path, std::string("mocap/") + GetParam().file);
    auto clip = readBvhFile(*path);
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    clip_ = std::move(clip).value();
  }
  Clip clip_;
};
class SharedPerson : public SharedClip {};

TEST_P(SharedClip, HasTheKnownJointsFramesAndRate) {
  EXPECT_EQ(clip_.skeleton.numJoints(), GetParam().joints);
  EXPECT_EQ(clip_.frames.size(), GetParam().frames);
  EXPECT_NEAR(1.0 / clip_.frameTimeS, GetParam().rateHz, 0.001 * GetParam().rateHz);
  EXPECT_TRUE(clip_.notes.empty());
}

TEST_P(SharedClip, PosesAreValidAndStayBitForBit) {
  for (const Pose& frame : clip_.frames) {
    const auto pose = validatedPose(clip_.skeleton, frame);
    ASSERT_TRUE(pose.ok()) << describe(pose.error());
    for (std::size_t j = 0; j < frame.rotations.size(); ++j) {
      ASSERT_EQ(pose.value().rotations[j].coeffs(), frame.rotations[j].coeffs());
    }
  }
}

/// Bones by the reader's account, and whether the link's LSS contain their ends.
void expectBonesContained(const Clip& clip, const Avatar& avatar, double shortest) {
  int bones = 0;
  const auto expectInside = [&](JointId joint, const Eigen::Vector3d& end) {
    if (end.norm() <= shortest) return;
    ++bones;
    bool contains = false;
    for (const Lss& lss : avatar.lss(joint)) {
      contains = contains || (axisDistance(lss, end) <= lss.radius &&
                              axisDistance(lss, Eigen::Vector3d::Zero()) <= lss.radius);
    }
    EXPECT_TRUE(contains) << clip.skeleton.name(joint);
  };
  for (JointId j = 0; j < clip.skeleton.numJoints(); ++j) {
    for (const auto& site : clip.endSites[static_cast<std::size_t>(j)]) expectInside(j, site);
    const JointId parent = clip.skeleton.parent(j);
    // A root above the hips carries nothing (bvh_avatar_test.cpp tests it).
    if (parent == kNoParent || clip.skeleton.name(parent) == "joint_Root") continue;
    expectInside(parent, clip.skeleton.restOffset(j));
  }
  EXPECT_GT(bones, 2);
}

double longestOffset(const Clip& clip) {
  double longest = 0.0;
  for (JointId j = 1; j < clip.skeleton.numJoints(); ++j) {
    longest = std::max(longest, clip.skeleton.restOffset(j).norm());
  }
  return longest;
}

TEST_P(SharedClip, GivesAnAvatarWhoseLssContainTheirBones) {
  const auto avatar = avatarFromClip(clip_);
  ASSERT_TRUE(avatar.ok()) << describe(avatar.error());
  expectBonesContained(clip_, avatar.value(), 1e-3 * longestOffset(clip_));
  const auto match = matchJoints(avatar.value().skeleton(), clip_.skeleton);
  ASSERT_TRUE(match.ok());
  EXPECT_TRUE(match.value().unmatchedAvatar.empty());
}

TEST_P(SharedPerson, RadiiAreThoseOfAPerson) {
  const auto avatar = avatarFromClip(clip_);
  ASSERT_TRUE(avatar.ok());
  // A thigh is the longest bone of most skeletons and near a quarter of stature; the shin's, at the
  // least, is a fifth. So radii can be judged without the code's own notion of stature.
  double thigh = 0.0;
  for (JointId j = 0; j < clip_.skeleton.numJoints(); ++j) {
    const std::string& name = clip_.skeleton.name(j);
    const bool isKnee = name.find("Knee") != name.npos || name.find("Leg") != name.npos ||
                        name.find("lowerleg01") != name.npos;
    if (isKnee) thigh = std::max(thigh, clip_.skeleton.restOffset(j).norm());
  }
  ASSERT_GT(thigh, 0.0);
  double largest = 0.0;
  double smallest = HUGE_VAL;
  for (LinkId i = 0; i < avatar.value().numLinks(); ++i) {
    for (const Lss& lss : avatar.value().lss(i)) {
      largest = std::max(largest, lss.radius);
      smallest = std::min(smallest, lss.radius);
    }
  }
  // In thighs of 0.43 m: the torso's radius from 12 to 21 cm, nothing thinner than 0.4 mm.
  EXPECT_GT(largest, 0.28 * thigh);
  EXPECT_LT(largest, 0.49 * thigh);
  EXPECT_GT(smallest, 0.001 * thigh);
}

std::string caseName(const ::testing::TestParamInfo<Recording>& instance) {
  std::string name;
  for (const char c : std::string(instance.param.file)) {
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return name;
}

std::vector<Recording> people() {
  std::vector<Recording> list = recordings();
  list.erase(std::remove_if(list.begin(), list.end(), [](const auto& r) { return !r.isHuman; }),
             list.end());
  return list;
}

INSTANTIATE_TEST_SUITE_P(AllRecordings, SharedClip, ::testing::ValuesIn(recordings()), caseName);
INSTANTIATE_TEST_SUITE_P(AllRecordings, SharedPerson, ::testing::ValuesIn(people()), caseName);

TEST(SharedClips, NoBvhFileIsLeftOut) {
  FORETOUCH_REQUIRE_SHARED(folder, "mocap");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() != ".bvh") continue;
    ++files;
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(std::any_of(recordings().begin(), recordings().end(), [&](const Recording& r) {
      return name == r.file;
    })) << name;
  }
  EXPECT_EQ(files, recordings().size());
}

}  // namespace
}  // namespace foretouch
