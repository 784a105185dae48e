// A link's LSS as other tools state capsules: whoever reads the numbers has a capsule that holds
// the LSS, whatever it makes of a turn; and hardly more. Judged in long doubles.
#include "tools/colliders/capsule_forms.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongTurn = Eigen::Quaternion<long double>;

/// Of every size: fingers to buildings, near and far from their joints.
Lss drawn(test::Random& random) {
  const double reach = random.magnitude(1e-3, 1e3);
  const Vector3d a = random.inBox(reach);
  const double length = random.chance(0.1) ? 0.0 : random.magnitude(1e-7, 1e2);
  const Vector3d along =
      random.chance(0.2) ? Vector3d(Vector3d::Unit(random.below(3))) : random.direction();
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  return {a, a + sign * length * along, random.chance(0.1) ? 0.0 : random.magnitude(1e-7, 1e1)};
}

/// How far `outer`, by ends and radius, is from holding `inner`: a convex body that holds the balls
/// about both ends holds the LSS.
long double lack(const Lss& inner, const Long3& a, const Long3& b, long double radius) {
  const Long3 innerA = inner.a.cast<long double>(), innerB = inner.b.cast<long double>();
  const long double straight = std::max((a - innerA).norm(), (b - innerB).norm());
  const long double turned = std::max((b - innerA).norm(), (a - innerB).norm());
  return std::min(straight, turned) + inner.radius - radius;
}

Long3 columnOf(const Eigen::Matrix3d& matrix, const Vector3d& axis) {
  return matrix.cast<long double>() * axis.cast<long double>();
}

bool isFloat(double number) {
  return static_cast<double>(static_cast<float>(number)) == number;
}

/// What may be added for rounding, as a share of the largest length.
double allowed(HeldAs held) {
  return held == HeldAs::Floats ? 1e-6 : 1e-13;
}

TEST(CapsuleForms, ByTheirEndsHoldTheLss) {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    test::Random random(seed);
    const Lss lss = drawn(random);
    const HeldAs held = random.chance(0.5) ? HeldAs::Floats : HeldAs::Doubles;
    const Lss found = byEnds(lss, held);
    ASSERT_LE(lack(lss, found.a.cast<long double>(), found.b.cast<long double>(), found.radius), 0)
        << seed;
    const double size = lss.radius + lss.a.norm() + (lss.b - lss.a).norm();
    ASSERT_LE(found.radius - lss.radius, allowed(held) * size) << seed;
    if (held == HeldAs::Doubles) continue;
    for (const double number : {found.a.x(), found.a.y(), found.b.z(), found.radius}) {
      ASSERT_TRUE(isFloat(number)) << seed;
    }
  }
}

TEST(CapsuleForms, ByTheirTurnHoldTheLssHoweverItIsRead) {
  int spheres = 0, capsules = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    test::Random random(seed);
    const Lss lss = asCollider(drawn(random));
    const HeldAs held = random.chance(0.5) ? HeldAs::Floats : HeldAs::Doubles;
    const Vector3d axis = random.chance(0.5) ? Vector3d::UnitY() : Vector3d::UnitZ();
    const StandingCapsule found = standing(lss, axis, held);
    ++(found.halfLength == 0.0 ? spheres : capsules);
    const Long3 middle = found.middle.cast<long double>();
    const LongTurn q = found.turn.cast<long double>();
    for (const Long3& along : {Long3(q.normalized() * axis.cast<long double>()),
                               Long3(q.toRotationMatrix() * axis.cast<long double>()),
                               columnOf(turnMatrix(found.turn, held), axis)}) {
      const Long3 half = static_cast<long double>(found.halfLength) * along;
      ASSERT_LE(lack(lss, middle - half, middle + half, found.radius), 0) << seed;
    }
    const double size = lss.radius + lss.a.norm() + (lss.b - lss.a).norm();
    ASSERT_LE(found.radius - lss.radius, 4.0 * allowed(held) * size) << seed;
    ASSERT_TRUE(held == HeldAs::Doubles || (isFloat(found.radius) && isFloat(found.halfLength) &&
                                            isFloat(found.turn.x()) && isFloat(found.middle.y())));
  }
  EXPECT_GT(spheres, 1000);
  EXPECT_GT(capsules, 10000);
}

/// Godot 4 and Unity state the whole height; the difference is taken in floats.
TEST(CapsuleForms, WholeHeightsKeepTheHalfLength) {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    test::Random random(seed);
    const StandingCapsule found =
        standing(asCollider(drawn(random)), Vector3d::UnitY(), HeldAs::Floats);
    const auto height = static_cast<float>(wholeHeight(found, HeldAs::Floats));
    const auto radius = static_cast<float>(found.radius);
    const volatile float half = 0.5f * height - radius;
    // Where the difference of two floats cannot tell so little, the height is too large, not too
    // small.
    ASSERT_GE(static_cast<double>(half), found.halfLength) << seed;
    ASSERT_LE(static_cast<double>(half), found.halfLength * (1.0 + 1e-6) + 4e-7 * found.radius);
  }
}

TEST(CapsuleForms, WhatNoToolTakesBecomesASphereOrThicker) {
  const Lss thin = asCollider({Vector3d::Zero(), Vector3d::UnitX(), 0.0});
  EXPECT_EQ(thin.radius, kLeastRadius);
  const Lss point = asCollider({Vector3d(1, 2, 3), Vector3d(1, 2, 3 + 5e-7), 0.1});
  EXPECT_EQ(point.a, point.b);
  EXPECT_GE(point.radius, 0.1 + 2.5e-7);
  EXPECT_LE(point.radius, 0.1 + 2.6e-7);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    test::Random random(seed);
    const Lss lss = drawn(random), found = asCollider(lss);
    ASSERT_LE(lack(lss, found.a.cast<long double>(), found.b.cast<long double>(), found.radius), 0)
        << seed;
  }
}

}  // namespace
}  // namespace foretouch::tools
