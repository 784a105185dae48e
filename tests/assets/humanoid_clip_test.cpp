// humanoidClip() against matrices: each part of the body turns in the world as the clip's.
#include "assets/avatar/humanoid_clip.h"

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assets/avatar/joint_match.h"
#include "assets/human_bones.h"
#include "tests/assets/humanoid_body.h"
#include "tests/support/holds.h"

namespace foretouch::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Clip clipOn(const Skeleton& skeleton, Random& random) {
  Clip clip;
  clip.skeleton = skeleton;
  clip.frameTimeS = 0.1;
  const auto n = static_cast<std::size_t>(skeleton.numJoints());
  for (int f = 0; f < 3; ++f) {
    Pose pose = restPose(skeleton);
    for (Quaternion& q : pose.rotations) q = random.rotation();
    pose.translations[0] = random.inBox(2.0);
    clip.frames.push_back(pose);
  }
  clip.hasRotation.assign(n, true);
  clip.hasTranslation.assign(n, false);
  clip.hasTranslation[0] = true;
  clip.endSites.resize(n);
  return clip;
}

/// From the leaf up.
Eigen::Matrix4d worldOf(const Skeleton& skeleton, const Pose& pose, JointId joint) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (JointId j = joint; j != kNoParent; j = skeleton.parent(j)) {
    Eigen::Matrix4d local = Eigen::Matrix4d::Identity();
    local.topLeftCorner<3, 3>() = pose.rotations[static_cast<std::size_t>(j)].toRotationMatrix();
    local.topRightCorner<3, 1>() = pose.translations[static_cast<std::size_t>(j)];
    m = local * m;
  }
  return m;
}

Matrix3d aboutY(double degrees) {
  return Eigen::AngleAxisd(degrees / 180.0 * kPi, Vector3d::UnitY()).toRotationMatrix();
}

TEST(HumanoidClip, EachPartTurnsInTheWorldAsTheClipsDoes) {
  const Matrix3d zUp = Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX()).toRotationMatrix();
  int tried = 0;
  for (std::string Part::*const scheme : {&Part::mixamo, &Part::biovision, &Part::bone}) {
    for (const Matrix3d& standing :
         {Matrix3d(Matrix3d::Identity()), aboutY(180), aboutY(90), zUp}) {
      Random random(static_cast<std::uint64_t>(tried++));
      const Skeleton avatar = body(&Part::bone, aboutY(180), true, random);
      const Clip clip = clipOn(body(scheme, standing, true, random), random);
      const auto made = humanoidClip(avatar, clip);
      ASSERT_TRUE(made.ok()) << describe(made.error());
      ASSERT_TRUE(made.value());
      const Matrix3d turn = standing * aboutY(-180);  // the avatar, to stand as the clip
      const Pose restA = restPose(avatar), restC = restPose(clip.skeleton);
      for (std::size_t f = 0; f < clip.frames.size(); ++f) {
        for (JointId j = 0; j < avatar.numJoints(); ++j) {
          const Eigen::Matrix4d moved = worldOf(clip.skeleton, clip.frames[f], j),
                                from = worldOf(clip.skeleton, restC, j),
                                at = worldOf(avatar, restA, j),
                                now = worldOf(avatar, made.value()->frames[f], j);
          const Matrix3d expected = moved.topLeftCorner<3, 3>() *
                                    from.topLeftCorner<3, 3>().transpose() * turn *
                                    at.topLeftCorner<3, 3>();
          EXPECT_LT((now.topLeftCorner<3, 3>() - expected).norm(), 1e-9) << avatar.name(j);
        }
        const Vector3d hips = worldOf(clip.skeleton, clip.frames[f], 0).topRightCorner<3, 1>();
        const Vector3d own = worldOf(avatar, made.value()->frames[f], 0).topRightCorner<3, 1>();
        EXPECT_LT((own - hips).norm(), 1e-9);
      }
      EXPECT_TRUE(matchJoints(avatar, made.value()->skeleton).ok());
    }
  }
  EXPECT_EQ(tried, 12);
}

TEST(HumanoidClip, LeavesAloneWhatNamesMatchOrWhatIsNoHumanoid) {
  Random random(1);
  const Skeleton avatar = body(&Part::bone, Matrix3d::Identity(), true, random);
  EXPECT_FALSE(humanoidClip(avatar, clipOn(avatar, random)).value());
  const Skeleton mixamo = body(&Part::mixamo, Matrix3d::Identity(), false, random);
  EXPECT_FALSE(humanoidClip(mixamo, clipOn(avatar, random)).value());
  RawSkeleton other;
  other.joints.push_back({"hips"});
  EXPECT_FALSE(humanoidClip(avatar, clipOn(Skeleton::build(other).value(), random)).value());
}

TEST(HumanoidClip, RefusesAClipThatRestsOtherwise) {
  Random random(2);
  const Skeleton avatar = body(&Part::bone, Matrix3d::Identity(), false, random);
  const Skeleton upright = body(&Part::mixamo, Matrix3d::Identity(), false, random);
  const auto withArmAt = [&](double degrees) {
    RawSkeleton raw;
    for (JointId j = 0; j < upright.numJoints(); ++j) {
      raw.joints.push_back(
          {upright.name(j), upright.parent(j), upright.restOffset(j), upright.restRotation(j)});
      if (upright.name(j) != "mixamorig:LeftForeArm") continue;
      const double angle = degrees / 180.0 * kPi;
      raw.joints.back().offset = 0.3 * Vector3d(std::cos(angle), -std::sin(angle), 0);
    }
    return clipOn(Skeleton::build(raw).value(), random);
  };
  const auto near = humanoidClip(avatar, withArmAt(20));
  ASSERT_TRUE(near.ok() && near.value());
  EXPECT_TRUE(holds(near.value()->notes.front(), "20 degrees off")) << near.value()->notes.front();
  const auto far = humanoidClip(avatar, withArmAt(45));
  ASSERT_FALSE(far.ok());
  EXPECT_EQ(far.error().code, ErrorCode::Mismatch);
  EXPECT_TRUE(holds(far.error().message, "'mixamorig:LeftArm' is 45 degrees off"))
      << far.error().message;
}

TEST(HumanoidClip, NotesLegsOfAnotherLength) {
  Random random(3);
  const Skeleton avatar = body(&Part::bone, Matrix3d::Identity(), false, random);
  const Skeleton tall = body(&Part::mixamo, 2.0 * Matrix3d::Identity(), false, random);
  const auto made = humanoidClip(avatar, clipOn(tall, random));
  ASSERT_TRUE(made.ok() && made.value());
  EXPECT_TRUE(holds(made.value()->notes.back(), "its legs are 2 times as long"));
}

TEST(HumanBones, OneSchemeCounts) {
  Random random(4);
  const auto found = humanBonesOf(body(&Part::biovision, Matrix3d::Identity(), false, random));
  EXPECT_EQ(found.size(), parts().size());
  EXPECT_EQ(found.count("leftShoulder"), 0u);  // Biovision's shoulder is the upper arm
  EXPECT_EQ(found.count("leftUpperArm"), 1u);
}

}  // namespace
}  // namespace foretouch::test
