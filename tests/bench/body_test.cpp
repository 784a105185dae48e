// tests/bench/body_test.cpp: avatars with fewer or more links.
#include "bench/body.h"

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "tests/bench/world.h"

namespace foretouch::tools {
namespace {

/// A trunk with two arms of two links each; the left ends in a hand, the right in a foot with toes.
Avatar smallBody() {
  RawSkeleton raw;
  raw.joints = {{"Hips", kNoParent, {0, 1, 0}, Quaternion::Identity()},
                {"LeftArm", 0, {0.2, 0.4, 0}, Quaternion::Identity()},
                {"LeftHand", 1, {0.5, 0, 0}, Quaternion::Identity()},
                {"RightLeg", 0, {-0.2, 0, 0}, Quaternion::Identity()},
                {"RightToeBase", 3, {0, -0.8, 0}, Quaternion::Identity()}};
  const Eigen::Vector3d o = Eigen::Vector3d::Zero();
  return Avatar::build(Skeleton::build(raw).value(), {{Lss{o, {0, 0.5, 0}, 0.15}},
                                                      {Lss{o, {0.5, 0, 0}, 0.05}},
                                                      {Lss{o, {0.1, 0, 0}, 0.03}},
                                                      {Lss{o, {0, -0.8, 0}, 0.08}},
                                                      {Lss{o, {0, 0, 0.1}, 0.02}}})
      .value();
}

TEST(BodyWithLinks, DropsTheLeastLeavesFirst) {
  const Avatar base = smallBody();
  const std::vector<std::vector<JointId>> kept = {{0}, {0, 3}, {0, 1, 3}, {0, 1, 2, 3}};
  for (int links = 1; links <= 4; ++links) {
    const auto body = bodyWithLinks(base, links);
    ASSERT_TRUE(body.ok());
    EXPECT_EQ(body.value().avatar.numLinks(), links);
    EXPECT_EQ(body.value().baseJoint, kept[static_cast<std::size_t>(links) - 1]);
  }
}

TEST(BodyWithLinks, GrowsFingersToesAndStrands) {
  const Avatar base = smallBody();
  for (const int links : {5, 6, 20, 25, 26, 128}) {
    const auto body = bodyWithLinks(base, links);
    ASSERT_TRUE(body.ok()) << describe(body.error());
    const Skeleton& skeleton = body.value().avatar.skeleton();
    ASSERT_EQ(skeleton.numJoints(), links);
    const auto childrenOf = [&](JointId parent) {
      int children = 0;
      for (JointId j = 5; j < links; ++j) children += skeleton.parent(j) == parent ? 1 : 0;
      return children;
    };
    if (links >= 20) {
      EXPECT_EQ(childrenOf(2), 5);
    }
    if (links >= 25) {
      EXPECT_EQ(childrenOf(4), 5);
    }
    if (links == 128) {
      EXPECT_EQ(childrenOf(0), 26);  // (128 - 25) links in strands of four
    }
  }
}

TEST(PoseOfBody, MovesTheBaseJointsAsTheBaseAndTheAddedOnesOnTheirOwn) {
  const Avatar base = smallBody();
  const auto body = bodyWithLinks(base, 40).value();
  Pose pose = restPose(base.skeleton());
  pose.rotations[1] = Quaternion(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  pose.translations[0] = {3, 1, -2};
  const auto at = [&](double timeS) {
    const auto valid = validatedPose(body.avatar.skeleton(), poseOfBody(body, pose, timeS));
    EXPECT_TRUE(valid.ok());
    return ChainMotion(body.avatar.skeleton(), valid.value(), valid.value());
  };
  const ChainMotion early = at(0.0), late = at(0.3);
  const ChainMotion ofBase(base.skeleton(), pose, pose);
  for (LinkId link = 0; link < 5; ++link) {
    EXPECT_EQ(early.stateAt(link, 0.0).p_WL, ofBase.stateAt(link, 0.0).p_WL);
    EXPECT_EQ(late.stateAt(link, 0.0).R_WL, ofBase.stateAt(link, 0.0).R_WL);
  }
  for (LinkId link = 5; link < 40; ++link) {
    EXPECT_GT((early.stateAt(link, 0.0).R_WL - late.stateAt(link, 0.0).R_WL).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace foretouch::tools
