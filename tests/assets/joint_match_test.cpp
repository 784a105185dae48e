#include "assets/avatar/joint_match.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

/// A chain of joints, the i-th at (i+1, 0, 0) from its parent.
Skeleton chainOf(const std::vector<std::string>& names) {
  RawSkeleton raw;
  for (std::size_t i = 0; i < names.size(); ++i) {
    RawJoint joint;
    joint.name = names[i];
    joint.parent = static_cast<JointId>(i) - 1;
    joint.offset.x() = static_cast<double>(i + 1);
    raw.joints.push_back(joint);
  }
  return Skeleton::build(raw).value();
}

Clip clipOf(const std::vector<std::string>& names) {
  Clip clip;
  clip.skeleton = chainOf(names);
  clip.frameTimeS = 0.1;
  Pose pose = restPose(clip.skeleton);
  for (std::size_t j = 0; j < names.size(); ++j) {
    pose.rotations[j] = Quaternion(0, 0, 1, 0);
    pose.translations[j] = Eigen::Vector3d(0, 0, static_cast<double>(j));
  }
  clip.frames.push_back(pose);
  clip.hasRotation.assign(names.size(), true);
  clip.hasTranslation.assign(names.size(), true);
  clip.endSites.resize(names.size());
  return clip;
}

TEST(MatchJoints, MatchesByNameAndListsTheRest) {
  const auto match =
      matchJoints(chainOf({"Hips", "Spine", "Tail"}), chainOf({"Head", "Spine", "Hips"}));
  ASSERT_TRUE(match.ok());
  EXPECT_EQ(match.value().clipJointOf, (std::vector<JointId>{2, 1, kNoParent}));
  EXPECT_EQ(match.value().unmatchedAvatar, std::vector<std::string>{"Tail"});
  EXPECT_EQ(match.value().unmatchedClip, std::vector<std::string>{"Head"});
}

TEST(MatchJoints, NeverGuesses) {
  const auto match = matchJoints(chainOf({"Hips", "leftarm"}), chainOf({"Hips", "LeftArm"}));
  ASSERT_TRUE(match.ok());
  EXPECT_EQ(match.value().unmatchedAvatar, std::vector<std::string>{"leftarm"});
}

TEST(MatchJoints, TheMapComesBeforeTheName) {
  const auto match =
      matchJoints(chainOf({"a", "b"}), chainOf({"a", "b", "c"}), {{"a", "c"}, {"b", "c"}});
  ASSERT_TRUE(match.ok());
  EXPECT_EQ(match.value().clipJointOf, (std::vector<JointId>{2, 2}));
  EXPECT_EQ(match.value().unmatchedClip, (std::vector<std::string>{"a", "b"}));
}

TEST(MatchJoints, RefusesAMapOfUnknownNames) {
  EXPECT_EQ(matchJoints(chainOf({"a"}), chainOf({"a"}), {{"x", "a"}}).error().code,
            ErrorCode::UnknownName);
  EXPECT_EQ(matchJoints(chainOf({"a"}), chainOf({"a"}), {{"a", "x"}}).error().code,
            ErrorCode::UnknownName);
}

TEST(MatchJoints, RefusesSkeletonsWithNothingInCommon) {
  const auto match = matchJoints(chainOf({"a", "b"}), chainOf({"c"}));
  ASSERT_FALSE(match.ok());
  EXPECT_EQ(match.error().code, ErrorCode::Mismatch);
}

TEST(PoseOfAvatar, TakesTheClipsDataAndElseTheAvatarsRest) {
  const Skeleton avatar = chainOf({"Tail", "b", "c", "d"});
  Clip clip = clipOf({"b", "c", "d"});
  clip.hasTranslation[1] = false;
  clip.hasRotation[2] = false;
  const auto match = matchJoints(avatar, clip.skeleton);
  ASSERT_TRUE(match.ok());
  const Pose pose = poseOfAvatar(avatar, clip, match.value(), 0);
  const Quaternion moved(0, 0, 1, 0);
  EXPECT_EQ(pose.rotations[0].coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(pose.translations[0], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(pose.rotations[1].coeffs(), moved.coeffs());
  EXPECT_EQ(pose.translations[1], Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(pose.rotations[2].coeffs(), moved.coeffs());
  EXPECT_EQ(pose.translations[2], Eigen::Vector3d(3, 0, 0));  // the avatar's, not the clip's 2
  EXPECT_EQ(pose.rotations[3].coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(pose.translations[3], Eigen::Vector3d(0, 0, 2));
}

TEST(Placed, WithoutArgumentsChangesNothing) {
  const Clip clip = clipOf({"a", "b"});
  const Pose pose = placed(clip.skeleton, clip.frames[0], {});
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(pose.rotations[j].coeffs(), clip.frames[0].rotations[j].coeffs());
    EXPECT_EQ(pose.translations[j], clip.frames[0].translations[j]);
  }
}

/// The point of a root's frame in the world.
Eigen::Vector3d pointOf(const Pose& pose, const Eigen::Vector3d& point) {
  return pose.translations[0] + pose.rotations[0] * point;
}

TEST(Placed, TurnsZUpThenYawsThenMoves) {
  const Skeleton skeleton = chainOf({"a", "b"});
  Pose pose = restPose(skeleton);
  pose.rotations[0] = unitQuaternion(Quaternion(0.5, 0.5, -0.5, 0.5)).value();
  pose.translations[0] = Eigen::Vector3d(1, 2, 3);
  const Eigen::Vector3d inRoot(0.3, -0.2, 0.7);
  const Eigen::Vector3d before = pointOf(pose, inRoot);
  Placement placement;
  placement.motionUpZ = true;
  placement.yawDeg = 30.0;
  placement.origin = Eigen::Vector3d(10, 20, 30);
  const Pose after = placed(skeleton, pose, placement);
  const Eigen::Vector3d upright(before.x(), before.z(), -before.y());
  const double c = std::sqrt(0.75);
  const Eigen::Vector3d expected(c * upright.x() + 0.5 * upright.z() + 10, upright.y() + 20,
                                 -0.5 * upright.x() + c * upright.z() + 30);
  EXPECT_LT((pointOf(after, inRoot) - expected).norm(), 1e-14);
  EXPECT_EQ(after.translations[1], pose.translations[1]);  // only roots move
  EXPECT_EQ(after.rotations[1].coeffs(), pose.rotations[1].coeffs());
  EXPECT_TRUE(validatedPose(skeleton, after).ok());
}

/// Hips, Spine and Head, each `length` above the one before.
Skeleton trunkOf(double length) {
  RawSkeleton raw;
  for (const char* name : {"Hips", "Spine", "Head"}) {
    raw.joints.push_back({name,
                          static_cast<JointId>(raw.joints.size()) - 1,
                          {0, length, 0},
                          Quaternion::Identity()});
  }
  return Skeleton::build(raw).value();
}

TEST(SuspiciousSize, IsOfMatchedBonesMoreThanTwiceOrLessThanHalfAsLong) {
  const Skeleton avatar = trunkOf(0.5);
  for (const double times : {100.0, 39.37, 2.01, 0.49, 0.01}) {
    const Skeleton clip = trunkOf(0.5 * times);
    const auto ratio = suspiciousSize(avatar, clip, matchJoints(avatar, clip).value());
    ASSERT_TRUE(ratio.has_value()) << times;
    EXPECT_NEAR(*ratio, times, 1e-12 * times);
  }
  for (const double times : {2.0, 1.0, 0.5}) {
    const Skeleton clip = trunkOf(0.5 * times);
    EXPECT_FALSE(suspiciousSize(avatar, clip, matchJoints(avatar, clip).value())) << times;
  }
}

TEST(SuspiciousSize, IsNotToldWithoutBones) {
  const Skeleton avatar = trunkOf(0.5), flat = trunkOf(0.0), other = chainOf({"Hips", "Tail"});
  EXPECT_FALSE(suspiciousSize(avatar, flat, matchJoints(avatar, flat).value()));
  EXPECT_FALSE(suspiciousSize(avatar, other, matchJoints(avatar, other).value()));
}

}  // namespace
}  // namespace foretouch
