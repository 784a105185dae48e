// tests/judge/rigid_prover_test.cpp: the rigid oracle on motions whose first contact is known in
// closed form, and on planted wrong answers.
#include "judge/rigid_prover.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

/// A pendulum over the floor y = 0: its tip is `length` from the pivot at `height`, and turns from
/// `from` to `to` (radians from straight down) about z. With unit ends q = q0 + t (q1 - q0).
struct Pendulum {
  double length = 1, height = 1, from = 0, to = 0;

  [[nodiscard]] RigidPair pair() const {
    RigidPair p;
    p.x0 = p.x1 = {0, height, 0};
    p.q0 = {std::cos(from / 2), 0, 0, std::sin(from / 2)};
    p.q1 = {std::cos(to / 2), 0, 0, std::sin(to / 2)};
    p.moving = {Vec3d{0, -length, 0}, Vec3d{0.01, 0, 0.01}, Vec3d{0.01, 0, -0.01}};
    p.fixed = {Vec3d{-50, 0, -50}, Vec3d{60, 0, -40}, Vec3d{0, 0, 70}};
    return p;
  }
  /// The tip's height: the quaternion's real angle at t, from the given doubles.
  [[nodiscard]] Real separation(Real t) const {
    const RigidPair p = pair();
    const Real w = p.q0[0] + t * (static_cast<Real>(p.q1[0]) - p.q0[0]);
    const Real z = p.q0[3] + t * (static_cast<Real>(p.q1[3]) - p.q0[3]);
    return height - length * std::cos(2 * std::atan2(z, w));
  }
};

Pendulum drawn(Random& random, double clearance) {
  Pendulum p;
  p.length = random.magnitude(0.2, 2.0);
  p.height = p.length + clearance;  // lowest at the bottom
  p.from = -random.uniform(0.2, 1.3);
  p.to = random.uniform(0.2, 1.3);
  return p;
}

TEST(RigidProver, MeasuresTheTipOfAPendulum) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(i);
    const Pendulum p = drawn(random, 0.05);
    const RigidProver prover(p.pair());
    for (const double t : {0.0, 0.3, 0.77, 1.0}) {
      // As doubles, two numbers this near may still round apart.
      EXPECT_NEAR(static_cast<double>(prover.separationAt(t) - p.separation(t)), 0.0, 1e-17);
    }
  }
}

TEST(RigidProver, ProvesAPassThatMissesByTheLeast) {
  for (const double clearance : {1e-2, 1e-6, 1e-10, 1e-13}) {
    SCOPED_TRACE(clearance);
    for (std::uint64_t i = 0; i < 5; ++i) {
      Random random(i);
      const Pendulum p = drawn(random, clearance);
      const double least = p.height - p.length;  // what clearance has become
      const RigidSpan free = RigidProver(p.pair()).prove(0, 1, least * (1 - 1e-3));
      EXPECT_TRUE(free.free) << "case " << i;
      EXPECT_EQ(free.grazing, 0u);
      const RigidSpan touching = RigidProver(p.pair()).prove(0, 1, least * (1 + 1e-3));
      EXPECT_TRUE(touching.touching.has_value()) << "case " << i;
    }
  }
}

TEST(RigidProver, FindsADipBetweenTwoFreeEnds) {
  for (const double depth : {1e-2, 1e-6, 1e-10, 1e-13}) {
    SCOPED_TRACE(depth);
    Random random(3);
    const Pendulum p = drawn(random, -depth);
    const RigidSpan span = RigidProver(p.pair()).prove(0, 1, 0.0);
    EXPECT_FALSE(span.free);
    ASSERT_TRUE(span.touching.has_value());
    EXPECT_LE(p.separation(*span.touching), 1e-16L);
  }
}

// Controls: an answer that is late, or early, by a little is refused.
TEST(RigidProver, RefusesPlantedTimes) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(i);
    Pendulum p = drawn(random, 0.0);
    p.height = 0.99 * p.length;    // starts free at the least angle
    double low = 0.0, high = 0.0;  // the first contact by bisection of the closed form
    while (high < 1 && p.separation(high) > 0) high += 0.01;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (p.separation(middle) > 0 ? low : high) = middle;
    }
    RigidProver prover(p.pair());
    EXPECT_TRUE(prover.prove(0, low - 1e-12, 0.0).free);
    EXPECT_FALSE(prover.prove(0, high + 1e-12, 0.0).free);
    EXPECT_TRUE(prover.prove(low - 1e-3, low - 1e-6, 0.0).free);  // early: nothing is met there
    EXPECT_TRUE(prover.prove(0, 1, 0.0).touching.has_value());    // never-hit
    EXPECT_FALSE(prover.prove(0, 0, 0.0).touching.has_value());   // always-hit
  }
}

TEST(RigidProver, NeedsNoUnitQuaternions) {
  Random random(5);
  RigidPair pair = drawn(random, 0.01).pair();
  RigidPair scaled = pair;
  for (double& c : scaled.q0) c *= 0.75;
  for (double& c : scaled.q1) c *= 0.75;
  for (const double t : {0.0, 0.4, 1.0}) {
    EXPECT_NEAR(static_cast<double>(RigidProver(pair).separationAt(t)),
                static_cast<double>(RigidProver(scaled).separationAt(t)), 1e-16);
  }
}

}  // namespace
}  // namespace foretouch::oracle
