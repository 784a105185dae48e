// What a plain BVH file means: offsets, channels, rotation order, units.
#include "assets/bvh/bvh_reader.h"

#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/assets/bvh_samples.h"

namespace foretouch {
namespace {

using test::edited;
using test::plainBvh;

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kRadiansPerDegree, axis).toRotationMatrix();
}

Clip parsed(const std::string& text, double scale = 1.0) {
  auto clip = parseBvh(text, "test.bvh", {scale});
  if (!clip.ok()) {
    ADD_FAILURE() << describe(clip.error());
    return {};
  }
  return std::move(clip).value();
}

TEST(ParseBvh, ReadsSkeletonFramesAndRate) {
  const Clip clip = parsed(plainBvh());
  ASSERT_EQ(clip.skeleton.numJoints(), 2);
  EXPECT_EQ(clip.skeleton.name(0), "Hips");
  EXPECT_EQ(clip.skeleton.name(1), "Spine");
  EXPECT_EQ(clip.skeleton.parent(0), kNoParent);
  EXPECT_EQ(clip.skeleton.parent(1), 0);
  EXPECT_EQ(clip.skeleton.restOffset(1), Eigen::Vector3d(0, 2, 0.5));
  EXPECT_TRUE(clip.skeleton.restRotation(1).isApprox(Quaternion::Identity(), 0.0));
  ASSERT_EQ(clip.endSites.size(), 2u);
  EXPECT_TRUE(clip.endSites[0].empty());
  ASSERT_EQ(clip.endSites[1].size(), 1u);
  EXPECT_EQ(clip.endSites[1][0], Eigen::Vector3d(0, 3, 0));
  EXPECT_EQ(clip.frames.size(), 2u);
  EXPECT_EQ(clip.frameTimeS, 0.025);
  EXPECT_EQ(clip.durationS(), 0.025);
  EXPECT_TRUE(clip.notes.empty());
}

TEST(ParseBvh, ComposesRotationsInFileOrder) {
  const Clip clip = parsed(plainBvh());
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d expected = turn(z, 40) * turn(x, 50) * turn(y, 60);
  EXPECT_LT((clip.frames[0].rotations[1].toRotationMatrix() - expected).norm(), 1e-15);

  const Clip other = parsed(edited(plainBvh(), "CHANNELS 3 Zrotation Xrotation Yrotation",
                                   "CHANNELS 3 Yrotation Zrotation Xrotation"));
  const Eigen::Matrix3d otherOrder = turn(y, 40) * turn(z, 50) * turn(x, 60);
  EXPECT_LT((other.frames[0].rotations[1].toRotationMatrix() - otherOrder).norm(), 1e-15);
  EXPECT_GT((expected - otherOrder).norm(), 0.1);  // the order is not idle in this sample
}

TEST(ParseBvh, PositionChannelsReplaceTheOffset) {
  const Clip clip = parsed(plainBvh());
  EXPECT_EQ(clip.frames[0].translations[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(clip.frames[1].translations[0], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(clip.skeleton.restOffset(0), Eigen::Vector3d(0, 1, 0));
  EXPECT_TRUE(clip.hasTranslation[0]);
}

TEST(ParseBvh, JointWithoutPositionChannelsKeepsItsOffset) {
  const Clip clip = parsed(plainBvh());
  EXPECT_EQ(clip.frames[0].translations[1], Eigen::Vector3d(0, 2, 0.5));
  EXPECT_FALSE(clip.hasTranslation[1]);
  EXPECT_TRUE(clip.hasRotation[1]);
}

TEST(ParseBvh, AxisWithoutAPositionChannelKeepsItsOffset) {
  const Clip clip = parsed(edited(plainBvh(), "CHANNELS 3 Zrotation Xrotation Yrotation",
                                  "CHANNELS 3 Zposition Xrotation Xposition"));
  EXPECT_EQ(clip.frames[0].translations[1], Eigen::Vector3d(60, 2, 40));
  EXPECT_LT(
      (clip.frames[0].rotations[1].toRotationMatrix() - turn(Eigen::Vector3d::UnitX(), 50)).norm(),
      1e-15);
  EXPECT_TRUE(clip.hasTranslation[1]);
}

TEST(ParseBvh, ScaleAppliesToLengthsAndNotToAngles) {
  const Clip metres = parsed(plainBvh());
  const Clip clip = parsed(plainBvh(), 0.01);
  EXPECT_EQ(clip.skeleton.restOffset(1), Eigen::Vector3d(0, 0.02, 0.005));
  EXPECT_EQ(clip.endSites[1][0], Eigen::Vector3d(0, 0.03, 0));
  EXPECT_EQ(clip.frames[0].translations[0], Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(clip.frames[0].rotations[1].coeffs(), metres.frames[0].rotations[1].coeffs());
}

TEST(ParseBvh, WholeTurnsLeaveRotationsUnit) {
  const Clip clip = parsed(edited(plainBvh(), "40 50 60", "720 -1080 999999"));
  EXPECT_NEAR(clip.frames[0].rotations[1].norm(), 1.0, 1e-15);
  const Eigen::Matrix3d expected = turn(Eigen::Vector3d::UnitY(), 999999 - 360 * 2777.0);
  EXPECT_LT((clip.frames[0].rotations[1].toRotationMatrix() - expected).norm(), 1e-11);
}

TEST(ParseBvh, EveryRotationOrderAndPlaceOfChannels) {
  const char* const names[] = {"Xrotation", "Yrotation", "Zrotation"};
  const double angles[] = {40, 50, 60};
  int orders = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const int c = 3 - a - b;
      if (a == b || c < 0 || c > 2 || c == a || c == b) continue;
      const std::string channels =
          std::string("CHANNELS 3 ") + names[a] + " " + names[b] + " " + names[c];
      const Clip clip =
          parsed(edited(plainBvh(), "CHANNELS 3 Zrotation Xrotation Yrotation", channels));
      const Eigen::Matrix3d expected = turn(Eigen::Vector3d::Unit(a), angles[0]) *
                                       turn(Eigen::Vector3d::Unit(b), angles[1]) *
                                       turn(Eigen::Vector3d::Unit(c), angles[2]);
      EXPECT_LT((clip.frames[0].rotations[1].toRotationMatrix() - expected).norm(), 1e-15)
          << channels;
      ++orders;
    }
  }
  EXPECT_EQ(orders, 6);
}

TEST(ParseBvh, RefusesAScaleThatIsNone) {
  for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    const auto clip = parseBvh(plainBvh(), "test.bvh", {scale});
    ASSERT_FALSE(clip.ok());
    EXPECT_EQ(clip.error().code, ErrorCode::OutOfRange);
  }
}

TEST(ReadBvhFile, NamesTheFileThatIsNotThere) {
  const auto clip = readBvhFile("/nonexistent/clip.bvh");
  ASSERT_FALSE(clip.ok());
  EXPECT_EQ(clip.error().code, ErrorCode::FileNotFound);
  EXPECT_EQ(clip.error().file, "/nonexistent/clip.bvh");
}

}  // namespace
}  // namespace foretouch
