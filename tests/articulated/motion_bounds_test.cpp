// Holds ChainMotion and its bounds against fifty-digit forward kinematics.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "lss/index.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::PreciseFrame;
using test::asDouble;
using test::Random;
using test::RandomMotion;
using Real = oracle::Precise;

/// Worst share of each rounding bound that was used, over all cases.
struct MotionShares {
  double origin = 0.0, rotation = 0.0, velocity = 0.0, spin = 0.0;
};

/// Velocity by a symmetric difference in fifty digits: its own error is about 1e-30.
oracle::Precise3 preciseVelocity(const RandomMotion& m, int link, double t, const Vector3d& p_L) {
  const Real h("1e-15");
  const auto before = oracle::preciseFrames(m.precise, Real(t) - h);
  const auto after = oracle::preciseFrames(m.precise, Real(t) + h);
  const auto i = static_cast<std::size_t>(link);
  return (1 / (2 * h)) * (after[i].at(p_L) - before[i].at(p_L));
}

void compare(const RandomMotion& m, double t, Random& random, MotionShares& shares) {
  const ChainMotion motion(m.skeleton, m.from, m.to);
  const auto frames = oracle::preciseFrames(m.precise, Real(t));
  std::vector<LinkState> all;
  motion.statesAt(t, all);
  for (LinkId link = 0; link < motion.numLinks(); ++link) {
    const auto i = static_cast<std::size_t>(link);
    const LinkState state = motion.stateAt(link, t);
    ASSERT_EQ(state.p_WL, all[i].p_WL) << "one link alone and all at once must agree bit for bit";
    ASSERT_EQ(state.R_WL, all[i].R_WL);
    const MotionBounds& b = motion.bounds(link);
    const double rho = random.magnitude(1e-3, 2.0);
    const Vector3d p_L = rho * random.direction();
    const double used = asDouble(oracle::norm(oracle::Precise3(state.p_WL) - frames[i].origin));
    ASSERT_LE(used, b.originRounding);
    shares.origin = std::max(shares.origin, used / b.originRounding);
    const Vector3d unit = random.direction();
    const double turned =
        asDouble(oracle::norm(oracle::Precise3(state.R_WL * unit) -
                              oracle::rotate(frames[i].rotation, oracle::Precise3(unit))));
    const double turnBound = b.rotationRounding + MotionBounds::kPointRounding;
    ASSERT_LE(turned, turnBound);
    shares.rotation = std::max(shares.rotation, turned / turnBound);
    ASSERT_LE(asDouble(oracle::norm(oracle::Precise3(state.pointAt(p_L)) - frames[i].at(p_L))),
              b.positionRoundingAt(p_L.norm()));
    const oracle::Precise3 v = preciseVelocity(m, link, t, p_L);
    const double velocityUsed = asDouble(oracle::norm(oracle::Precise3(state.velocityAt(p_L)) - v));
    ASSERT_LE(velocityUsed, b.velocityRoundingAt(p_L.norm()));
    shares.velocity = std::max(shares.velocity, velocityUsed / b.velocityRoundingAt(p_L.norm()));
    ASSERT_LE(asDouble(oracle::norm(v)), b.speedAt(p_L.norm()));
  }
}

// Owns kJointRotation, kJointRate, kProduct and MotionBounds::kPointRounding.
TEST(ChainMotion, RoundingStaysBelowItsBounds) {
  MotionShares shares;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(12));
    compare(m, random.chance(0.2) ? 1.0 : random.uniform(1e-6, 1.0), random, shares);
    if (HasFatalFailure()) return;
  }
  std::cout << "worst shares of the rounding bounds used: origin " << shares.origin << ", rotation "
            << shares.rotation << ", velocity " << shares.velocity << "\n";
  for (const double share : {shares.origin, shares.rotation, shares.velocity}) {
    EXPECT_LT(share, 0.5);
    EXPECT_GT(share, 1e-3) << "the test no longer sees any rounding";
  }
}

// At a half turn both arcs are equally short and the definition decides: by the sign of the dot
// product of the quaternions as given, however small. An answer for the other arc would be about
// another motion.
TEST(ChainMotion, HalfTurnsTakeTheArcOfTheDotProductsSign) {
  int negative = 0;
  constexpr int kCases = 2000;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    RandomMotion m = test::randomMotion(random, 1);
    const Quaternion from = m.from.rotations[0];
    Quaternion to = from * random.turn(3.14159265358979323846);
    if (random.chance(0.5)) to.coeffs() = -to.coeffs();
    m.to.rotations[0] = to;
    const auto precise = test::plainJoints(m.skeleton, m.from, m.to);
    const Vector3d p_L = random.direction();
    const auto truth = oracle::preciseFrames(precise, Real(0.5))[0].at(p_L);
    const LinkState state = ChainMotion(m.skeleton, m.from, m.to).stateAt(0, 0.5);
    ASSERT_LE(asDouble(oracle::norm(oracle::Precise3(state.pointAt(p_L)) - truth)), 1e-11);
    negative += from.w() * to.w() + from.x() * to.x() + from.y() * to.y() + from.z() * to.z() < 0.0;
  }
  EXPECT_GT(negative, kCases / 4);
  EXPECT_LT(negative, kCases * 3 / 4);
}

// x(t) - chord over [s,e] is at most A h^2/8, and |x(e) - x(s)| at most V h: what the sweep and the
// advancement use. Checked on the true motion, on spans of every length.
TEST(MotionBounds, SpeedAndAccelerationBoundTheTrueMotion) {
  double tightestChord = 0.0, tightestSpeed = 0.0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(8));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    const double h = random.magnitude(1e-4, 1.0), s = random.uniform(0.0, 1.0 - h);
    const auto begin = oracle::preciseFrames(m.precise, Real(s));
    const auto end = oracle::preciseFrames(m.precise, Real(s) + Real(h));
    const Real share(random.uniform(0.0, 1.0));
    const auto between = oracle::preciseFrames(m.precise, Real(s) + share * Real(h));
    for (LinkId link = 0; link < motion.numLinks(); ++link) {
      const auto l = static_cast<std::size_t>(link);
      const Vector3d p_L = random.magnitude(1e-3, 1.0) * random.direction();
      const MotionBounds& b = motion.bounds(link);
      const auto chord = begin[l].at(p_L) + share * (end[l].at(p_L) - begin[l].at(p_L));
      const double sagitta = asDouble(oracle::norm(between[l].at(p_L) - chord));
      const double allowed = b.accelerationAt(p_L.norm()) * h * h / 8.0;
      ASSERT_LE(sagitta, allowed + 1e-40);
      if (allowed > 0.0) tightestChord = std::max(tightestChord, sagitta / allowed);
      const double moved = asDouble(oracle::norm(end[l].at(p_L) - begin[l].at(p_L)));
      ASSERT_LE(moved, b.speedAt(p_L.norm()) * h);
      tightestSpeed = std::max(tightestSpeed, moved / (b.speedAt(p_L.norm()) * h));
    }
  }
  // A bound that nothing comes near would be useless.
  EXPECT_GT(tightestChord, 0.8);
  EXPECT_GT(tightestSpeed, 0.9);
}

/// Bounds on the rounding of one link's state, as motion_bounds.md 3 carries them down a chain.
struct CarriedRounding {
  double rotation = 0.0, origin = 0.0, spin = 0.0, velocity = 0.0;
  double angularSpeed = 0.0, speed = 0.0, reach = 0.0;
};

CarriedRounding carried(const CarriedRounding& parent, const ChainMotion::JointBounds& joint) {
  constexpr double kU = 0x1p-53, kJointRotation = 128 * kU, kJointRate = 64 * kU,
                   kProduct = 16 * kU;
  const double f = parent.rotation + kProduct;
  CarriedRounding own;
  own.angularSpeed = parent.angularSpeed + joint.turn;
  own.speed = parent.speed + parent.angularSpeed * joint.length + joint.driftLength;
  own.reach = parent.reach + joint.length;
  own.rotation = parent.rotation + kJointRotation + kProduct;
  own.origin = parent.origin + f * joint.length + 2 * kU * own.reach;
  own.spin =
      parent.spin + f * joint.turn + kJointRate * (1 + joint.turn) + 2 * kU * own.angularSpeed;
  own.velocity = parent.velocity + (parent.spin + 2 * parent.angularSpeed * f) * joint.length +
                 f * joint.driftLength + 4 * kU * own.speed;
  return own;
}

TEST(MotionBounds, RoundingIsNeverBelowWhatIsCarriedDownTheChain) {
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(6));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    std::vector<CarriedRounding> sums;
    for (LinkId link = 0; link < motion.numLinks(); ++link) {
      const JointId parent = motion.parent(link);
      sums.push_back(carried(parent == kNoParent ? CarriedRounding() : sums[slotOf(parent)],
                             motion.jointBounds(link)));
      const CarriedRounding& least = sums.back();
      const MotionBounds b = motion.bounds(link);
      EXPECT_GE(b.rotationRounding, least.rotation);
      EXPECT_GE(b.originRounding, least.origin);
      EXPECT_GE(b.spinRounding, least.spin);
      EXPECT_GE(b.velocityRounding, least.velocity);
      if (parent != kNoParent) continue;  // of one joint they are the same
      EXPECT_NEAR(b.rotationRounding / least.rotation, 1.0, 1e-11);
      EXPECT_NEAR(b.originRounding / least.origin, 1.0, 1e-11);
      EXPECT_NEAR(b.spinRounding / least.spin, 1.0, 1e-11);
    }
  }
}

// The angle is bounded by the chord: for turns of every size, and never by much more than the turn.
TEST(MotionBounds, TurnsOfEverySizeAreBoundedAndNearlyMet) {
  constexpr double kPi = 3.14159265358979323846;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const double angle = i % 10 == 0 ? kPi : random.magnitude(1e-12, kPi);
    RandomMotion m = test::randomMotion(random, 1);
    m.to.rotations[0] = m.from.rotations[0] * random.turn(angle);
    const ChainMotion motion(m.skeleton, m.from, m.to);
    // The turn as built is off by a few roundings from the angle asked for.
    EXPECT_GE(motion.bounds(0).angularSpeed, angle - 1e-15);
    EXPECT_LE(motion.bounds(0).angularSpeed, angle * 1.009 + 1e-13);
  }
}

TEST(MotionBounds, AngularBoundsHold) {
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(6));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    const double t = random.uniform(0.01, 0.9), h = 1e-5;
    for (LinkId link = 0; link < motion.numLinks(); ++link) {
      const Vector3d w0 = motion.stateAt(link, t).w_WL, w1 = motion.stateAt(link, t + h).w_WL;
      const MotionBounds& b = motion.bounds(link);
      EXPECT_LE(w0.norm(), b.angularSpeed);
      EXPECT_LE((w1 - w0).norm() / h, b.angularAcceleration + 1e-8);
    }
  }
}

}  // namespace
}  // namespace foretouch
