#include <cmath>

#include <gtest/gtest.h>

#include "articulated/skeleton.h"

namespace foretouch {
namespace {

Skeleton placedJoints() {
  RawSkeleton raw;
  raw.joints.resize(2);
  raw.joints[0].name = "a";
  raw.joints[0].offset = Eigen::Vector3d(1, 2, 3);
  raw.joints[1].name = "b";
  raw.joints[1].parent = 0;
  raw.joints[1].rotation = Quaternion(0, 1, 0, 0);
  return Skeleton::build(raw).value();
}

TEST(RestPose, HasTheSkeletonsValues) {
  const Pose pose = restPose(placedJoints());
  ASSERT_EQ(pose.rotations.size(), 2u);
  EXPECT_EQ(pose.translations[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(pose.rotations[1].coeffs(), Quaternion(0, 1, 0, 0).coeffs());
}

TEST(ValidatedPose, AcceptsTheRestPoseBitForBit) {
  const Pose rest = restPose(placedJoints());
  const auto pose = validatedPose(placedJoints(), rest);
  ASSERT_TRUE(pose.ok());
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(pose.value().rotations[j].coeffs(), rest.rotations[j].coeffs());
    EXPECT_EQ(pose.value().translations[j], rest.translations[j]);
  }
}

TEST(ValidatedPose, RefusesACountThatDoesNotFit) {
  for (const std::size_t count : {0u, 1u, 3u}) {
    Pose pose = restPose(placedJoints());
    pose.rotations.resize(count, Quaternion::Identity());
    EXPECT_EQ(validatedPose(placedJoints(), pose).error().code, ErrorCode::Mismatch);
    pose = restPose(placedJoints());
    pose.translations.resize(count, Eigen::Vector3d::Zero());
    EXPECT_EQ(validatedPose(placedJoints(), pose).error().code, ErrorCode::Mismatch);
  }
}

void expectRefusal(const Pose& pose, ErrorCode code) {
  const auto result = validatedPose(placedJoints(), pose);
  ASSERT_FALSE(result.ok());
  EXPECT_STREQ(toString(result.error().code), toString(code));
  EXPECT_EQ(result.error().index, 1);
}

TEST(ValidatedPose, RefusesNumbersOutOfRangeAndNamesTheJoint) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    Pose pose = restPose(placedJoints());
    pose.translations[1].z() = bad;
    expectRefusal(pose, ErrorCode::NonFinite);
    pose = restPose(placedJoints());
    pose.rotations[1].y() = bad;
    expectRefusal(pose, ErrorCode::NonFinite);
  }
  Pose pose = restPose(placedJoints());
  pose.translations[1].x() = 1.1 * kMaxCoordinate;
  expectRefusal(pose, ErrorCode::OutOfRange);
  pose = restPose(placedJoints());
  pose.rotations[1] = Quaternion(0, 0, 0, 0);
  expectRefusal(pose, ErrorCode::OutOfRange);
  pose.rotations[1] = Quaternion(1, 1, 0, 0);
  expectRefusal(pose, ErrorCode::OutOfRange);
}

TEST(ValidatedPose, MakesRotationsUnit) {
  Pose pose = restPose(placedJoints());
  pose.rotations[1] = Quaternion(0.6004, 0.8004, 0, 0);
  const auto result = validatedPose(placedJoints(), pose);
  ASSERT_TRUE(result.ok());
  EXPECT_NEAR(result.value().rotations[1].norm(), 1.0, 1e-15);
}

}  // namespace
}  // namespace foretouch
