#include "tessellation/swept_lss.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::Random;
using Real = oracle::Precise;

bool containsPrecisely(const Aabb& box, const Precise3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    const Real& x = p[static_cast<std::size_t>(axis)];
    if (x < Real(box.min[axis]) || x > Real(box.max[axis])) return false;
  }
  return true;
}

// The promise of a certified piece, on the true motion in fifty digits: random points of the LSS,
// its extreme points along the axes among them, at times inside the span and at its very ends.
TEST(SweptBox, ContainsTheLssThroughoutTheSpan) {
  int checked = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::RandomMotion m = test::randomMotion(random, 1 + random.below(8));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    const LinkId link = random.below(motion.numLinks());
    Lss lss{random.inBox(0.3), random.inBox(0.3),
            random.chance(0.2) ? 0.0 : random.magnitude(1e-6, 1)};
    if (random.chance(0.2)) lss.b = lss.a;
    const double h = random.magnitude(1e-6, 1.0), s = random.uniform(0.0, 1.0 - h);
    const double e = s + h, margin = random.chance(0.5) ? 0.0 : 1e-3;
    const AxisBounds bounds = axisBounds(lss, motion.bounds(link));
    const Aabb box = sweptBox(lss, bounds, axisEnds(lss, motion.stateAt(link, s)),
                              axisEnds(lss, motion.stateAt(link, e)), e - s, margin);
    for (int k = 0; k < 6; ++k) {
      const double t = k == 0 ? s : (k == 1 ? e : std::min(e, s + random.uniform(0.0, 1.0) * h));
      const auto frame = oracle::preciseFrames(m.precise, Real(t))[static_cast<std::size_t>(link)];
      const Precise3 a = frame.at(lss.a), b = frame.at(lss.b);
      const Precise3 onAxis = a + Real(random.uniform(0, 1)) * (b - a);
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
          const Precise3 offset(Vector3d(sign * (lss.radius + margin) * Vector3d::Unit(axis)));
          ASSERT_TRUE(containsPrecisely(box, a + offset));
          ASSERT_TRUE(containsPrecisely(box, b + offset));
          ASSERT_TRUE(containsPrecisely(box, onAxis + offset));
          checked += 3;
        }
      }
    }
  }
  EXPECT_GT(checked, 100000);
}

// A joint that turns by 0.8 rad about z: its points' speed and acceleration are closed forms. The
// turn's bound is at most 1.009 times the turn.
TEST(AxisBounds, AreThoseOfTheEnds) {
  RawSkeleton raw;
  raw.joints = {{"only", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Skeleton skeleton = Skeleton::build(raw).value();
  const Pose from = restPose(skeleton);
  Pose to = from;
  constexpr double kTurn = 0.8, kSlack = 1.02;
  to.rotations[0] = Eigen::AngleAxisd(kTurn, Vector3d::UnitZ());
  const MotionBounds bounds = ChainMotion(skeleton, from, to).bounds(0);
  for (const bool isTurned : {false, true}) {
    const Vector3d near(0.1, 0, 0), far(0, 0.5, 0);
    const Lss lss{isTurned ? far : near, isTurned ? near : far, 0.05};
    const AxisBounds got = axisBounds(lss, bounds);
    const auto expectAbove = [](double bound, double least) {
      EXPECT_GE(bound, least);
      EXPECT_LE(bound, kSlack * least);
    };
    expectAbove(got.speed, kTurn * 0.5);
    expectAbove(got.accelerationA, kTurn * kTurn * lss.a.norm());
    expectAbove(got.accelerationB, kTurn * kTurn * lss.b.norm());
    expectAbove(got.positionRoundingA, bounds.positionRoundingAt(lss.a.norm()));
    expectAbove(got.positionRoundingB, bounds.positionRoundingAt(lss.b.norm()));
    expectAbove(got.velocityRoundingA, bounds.velocityRoundingAt(lss.a.norm()));
    expectAbove(got.velocityRoundingB, bounds.velocityRoundingAt(lss.b.norm()));
  }
}

TEST(SweptBox, ConvergesQuadraticallyToTheChord) {
  Random random(7);
  const test::RandomMotion m = test::randomMotion(random, 4);
  const ChainMotion motion(m.skeleton, m.from, m.to);
  const Lss lss{Vector3d::Zero(), Vector3d(0.1, 0, 0), 0.0};
  const AxisBounds bounds = axisBounds(lss, motion.bounds(3));
  double previous = 0.0;
  for (const double h : {0.1, 0.05, 0.025}) {
    const AxisEnds begin = axisEnds(lss, motion.stateAt(3, 0.5));
    const AxisEnds end = axisEnds(lss, motion.stateAt(3, 0.5 + h));
    Aabb tight;
    for (const AxisEnds& ends : {begin, end}) {
      tight.add(ends.a);
      tight.add(ends.b);
    }
    const double excess = tight.min.x() - sweptBox(lss, bounds, begin, end, h, 0.0).min.x();
    EXPECT_GE(excess, 0.0);
    if (previous > 0.0) {
      EXPECT_NEAR(excess / previous, 0.25, 0.01);
    }
    previous = excess;
  }
}

TEST(Aabb, GrowsOutwardPastRounding) {
  Aabb box;
  box.add(Vector3d(1e4, 1e4, 1e4));
  box.grow(1e-13);
  EXPECT_LT(box.min.x(), 1e4);  // 1e-13 alone would be lost
  EXPECT_GT(box.max.x(), 1e4);
  EXPECT_TRUE(box.contains(Vector3d(1e4, 1e4, 1e4)));
}

// In fifty digits; faces far larger and far smaller than the distance, and than each other.
TEST(Aabb, GrowsEveryFaceByAtLeastTheDistanceAndLittleMore) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    Vector3d low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = random.magnitude(1e-12, 1e7) * (random.chance(0.5) ? 1.0 : -1.0);
      high[axis] = low[axis] + random.magnitude(1e-12, 1e7);
    }
    Aabb box;
    box.add(low);
    box.add(high);
    const double distance = random.magnitude(1e-12, 1e7);
    box.grow(distance);
    for (int axis = 0; axis < 3; ++axis) {
      const Real down = Real(low[axis]) - Real(box.min[axis]) - Real(distance);
      const Real up = Real(box.max[axis]) - Real(high[axis]) - Real(distance);
      ASSERT_GE(down, Real(0));
      ASSERT_GE(up, Real(0));
      ASSERT_LE(down, Real(0x1p-49) * Real(std::abs(low[axis]) + distance));
      ASSERT_LE(up, Real(0x1p-49) * Real(std::abs(high[axis]) + distance));
    }
  }
}

TEST(Aabb, DistanceIsThatOfTheNearestPoints) {
  Aabb left, right;
  left.add(Vector3d(0, 0, 0));
  left.add(Vector3d(1, 1, 1));
  right.add(Vector3d(4, 5, 0.5));
  EXPECT_DOUBLE_EQ(left.distance(right), 5.0);
  EXPECT_DOUBLE_EQ(right.distance(left), 5.0);
  right.add(Vector3d(1, 1, 1));
  EXPECT_EQ(left.distance(right), 0.0);
}

TEST(Aabb, TouchingBoxesOverlapAndAnEmptyOneNever) {
  Aabb left, right;
  left.add(Vector3d(0, 0, 0));
  left.add(Vector3d(1, 1, 1));
  right.add(Vector3d(1, 0, 0));
  right.add(Vector3d(2, 1, 1));
  EXPECT_TRUE(left.overlaps(right));
  EXPECT_FALSE(left.overlaps(Aabb{}));
}

}  // namespace
}  // namespace foretouch
