#include "tools/report/track_builder.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

/// Poses in which the links of `moves` are elsewhere each time.
std::vector<Pose> randomPoses(const Skeleton& skeleton, std::size_t count,
                              const std::vector<bool>& moves, test::Random& random) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    Pose pose = restPose(skeleton);
    for (std::size_t link = 0; link < moves.size(); ++link) {
      const Eigen::Vector4d q = Eigen::Vector4d(random.uniform(-1, 1), random.uniform(-1, 1),
                                                random.uniform(-1, 1), random.uniform(0.1, 1))
                                    .normalized();
      pose.rotations[link] = Quaternion(q[3], q[0], q[1], q[2]);
      if (moves[link] && i > 0) pose.translations[link] = 3.0 * random.direction();
    }
    poses.push_back(validatedPose(skeleton, pose).value());
  }
  return poses;
}

void expectSameBits(const Pose& found, const Pose& pose) {
  ASSERT_EQ(found.rotations.size(), pose.rotations.size());
  for (std::size_t link = 0; link < pose.rotations.size(); ++link) {
    EXPECT_EQ(std::memcmp(found.rotations[link].coeffs().data(),
                          pose.rotations[link].coeffs().data(), 4 * sizeof(double)),
              0);
    EXPECT_EQ(std::memcmp(found.translations[link].data(), pose.translations[link].data(),
                          3 * sizeof(double)),
              0);
  }
}

TEST(TrackBuilder, KeepsPosesBitForBit) {
  const ReplayInputs inputs = test::smallInputs({0, 1});
  const Skeleton& skeleton = inputs.avatar.skeleton();
  for (int i = 0; i < 40; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const auto poses = randomPoses(skeleton, 5, {(i & 1) != 0, (i & 2) != 0}, random);
    TrackBuilder builder(inputs.avatar, std::nullopt);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      builder.addPose(0.1 * static_cast<double>(k), poses[k]);
    }
    const ViewTrack track = builder.finish();
    EXPECT_EQ(track.poses(), 5u);
    EXPECT_EQ(track.moving.size(), static_cast<std::size_t>((i & 1) + (i >> 1 & 1)));
    for (std::size_t k = 0; k < poses.size(); ++k) expectSameBits(poseOf(track, k), poses[k]);
    EXPECT_TRUE(track.touchingFirst.empty());
  }
}

TEST(TrackBuilder, TellsZerosApart) {
  const ReplayInputs inputs = test::smallInputs({0, 1});
  const Pose rest = restPose(inputs.avatar.skeleton());
  Pose other = rest;
  other.translations[0].x() = -0.0;
  TrackBuilder builder(inputs.avatar, std::nullopt);
  builder.addPose(0.0, rest);
  builder.addPose(1.0, rest);
  builder.addPose(2.0, other);
  builder.addPose(3.0, rest);
  const ViewTrack track = builder.finish();
  EXPECT_EQ(track.moving, std::vector<LinkId>{0});
  for (std::size_t i = 0; i < 4; ++i) expectSameBits(poseOf(track, i), i == 2 ? other : rest);
}

TEST(TrackBuilder, SaysWhatEachPoseTouches) {
  // A sphere of 0.1 m and an arm of 0.05 m, moving along x through a wall at x = 0.
  const ReplayInputs inputs = test::smallInputs({-1, -0.08, 0.03, 0.2});
  TrackBuilder builder(inputs.avatar, touchQuestion(inputs.avatar, inputs.scene, inputs.query));
  for (std::int64_t i = 0; i < 4; ++i) {
    builder.addPose(inputs.timeOfStep(i), poseAtFrame(inputs, i).value());
  }
  EXPECT_FALSE(builder.touches(0, 0));
  EXPECT_TRUE(builder.touches(1, 0));
  EXPECT_FALSE(builder.touches(1, 1));
  EXPECT_TRUE(builder.touches(2, 1));
  const Eigen::AlignedBox3d box = builder.box();
  EXPECT_NEAR(box.min().x(), -1.1, 1e-12);
  EXPECT_NEAR(box.max().y(), 0.85, 1e-12);
  const ViewTrack track = builder.finish();
  EXPECT_EQ(track.touchingFirst, (std::vector<std::uint32_t>{0, 0, 1, 3, 3}));
  EXPECT_EQ(track.touching, (std::vector<std::uint16_t>{0, 0, 1}));
}

}  // namespace
}  // namespace foretouch::tools
