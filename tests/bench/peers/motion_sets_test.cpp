// The made-up motions of `bench peers` are what they say.
#include "bench/peers/motion_sets.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "tests/support/judged.h"
#include "tests/tools/random_clutter.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using tools::drawnSet;
using tools::kMotionSets;
using tools::MotionSet;
using tools::MotionSetKind;
using tools::RigidSweep;

constexpr std::size_t kMotions = 40;

MotionSet setOf(const MotionSetKind& kind, std::size_t motions = kMotions, std::uint64_t seed = 1) {
  const oracle::Scene scene(plain(randomClutter(150, 2)));
  return drawnSet(kind, scene, motions, seed).value();
}

TEST(MotionSets, HalfCollideAndAllStartClear) {
  const oracle::Scene scene(plain(randomClutter(150, 2)));
  for (const MotionSetKind& kind : kMotionSets) {
    SCOPED_TRACE(kind.name);
    const MotionSet set = setOf(kind, kMotions + 1);
    ASSERT_EQ(set.sweeps.size(), kMotions + 1);
    ASSERT_EQ(set.truths.size(), kMotions + 1);
    std::size_t touching = 0;
    for (std::size_t i = 0; i < set.sweeps.size(); ++i) {
      const auto axis = axisAt(set.sweeps[i], 0.0);
      EXPECT_GT(oracle::distanceTo(scene, plain(axis.a), plain(axis.b), 1.0),
                kind.radius + tools::kStartClearance);
      touching += set.truths[i].touches ? 1 : 0;
      EXPECT_LE(set.truths[i].isDeep, set.truths[i].touches);
      EXPECT_GE(set.truths[i].comesNear, set.truths[i].touches);
      EXPECT_EQ(set.truths[i].toi < 1.0, set.truths[i].touches);
    }
    EXPECT_EQ(touching, kMotions / 2);
  }
}

TEST(MotionSets, KeepTheirTravelTurnAndShape) {
  for (const MotionSetKind& kind : kMotionSets) {
    SCOPED_TRACE(kind.name);
    double mostTravel = 0.0, mostTurn = 0.0;
    for (const RigidSweep& sweep : setOf(kind).sweeps) {
      mostTravel = std::max(mostTravel, (sweep.to - sweep.from).norm());
      mostTurn = std::max(mostTurn, sweep.turn.norm());
      EXPECT_NEAR((sweep.lss_L.b - sweep.lss_L.a).norm(), 0.3, 1e-12);
      EXPECT_EQ(sweep.lss_L.radius, kind.radius);
      EXPECT_NEAR(sweep.rotation.norm(), 1.0, 1e-12);
    }
    EXPECT_LE(mostTravel, kind.mostTravel);
    EXPECT_GT(mostTravel, 0.8 * kind.mostTravel);
    EXPECT_LE(mostTurn, kind.mostTurn);
    EXPECT_GE(mostTurn, 0.8 * kind.mostTurn);
  }
  EXPECT_EQ(kMotionSets[1].mostTurn, 0.0);
}

TEST(MotionSets, FollowTheSeed) {
  const MotionSet one = setOf(kMotionSets[0]), same = setOf(kMotionSets[0]),
                  other = setOf(kMotionSets[0], kMotions, 2);
  for (std::size_t i = 0; i < kMotions; ++i) {
    EXPECT_EQ(one.sweeps[i].from, same.sweeps[i].from);
    EXPECT_EQ(one.truths[i].toi, same.truths[i].toi);
    EXPECT_NE(one.sweeps[i].from, other.sweeps[i].from);
  }
}

TEST(MotionSets, RefuseASceneThatTheyCannotTouch) {
  const Triangle small{{Vector3d(0, 0, 0), Vector3d(1e-6, 0, 0), Vector3d(0, 1e-6, 0)}};
  const oracle::Scene speck({plain(small)});
  // Every motion starts at the speck, where it may not.
  const auto set = drawnSet(kMotionSets[0], speck, 2, 1);
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().code, ErrorCode::Empty);
}

// The one motion that every solver is told is, to Foretouch, a step of a joint at the pivot.
TEST(RigidSweep, IsTheMotionOfOneJoint) {
  RawSkeleton raw;
  raw.joints.push_back({"link", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  for (const RigidSweep& sweep : setOf(kMotionSets[0]).sweeps) {
    Pose from = restPose(skeleton), to = from;
    from.translations[0] = sweep.from;
    from.rotations[0] = sweep.rotation;
    to.translations[0] = sweep.to;
    to.rotations[0] = poseAt(sweep, 1.0).rotation;
    const ChainMotion motion(skeleton, from, to);
    double fastest = 0.0;
    for (int i = 0; i <= 8; ++i) {
      const double t = i / 8.0;
      const LinkState state = motion.stateAt(0, t);
      const auto axis = axisAt(sweep, t);
      EXPECT_NEAR((state.pointAt(sweep.lss_L.a) - axis.a).norm(), 0.0, 1e-14);
      EXPECT_NEAR((state.pointAt(sweep.lss_L.b) - axis.b).norm(), 0.0, 1e-14);
      fastest = std::max(fastest, state.velocityAt(sweep.lss_L.b).norm());
    }
    EXPECT_LE(fastest, fastestAxisPoint(sweep) * (1.0 + 1e-12));
    EXPECT_LE(displacement(sweep, 0.2, 0.7), 0.5 * fastestAxisPoint(sweep));
    EXPECT_GT(displacement(sweep, 0.2, 0.7), 0.0);
  }
}

}  // namespace
}  // namespace foretouch::test
