#include "lss/turn_between.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// A cosine near -1 leaves half of the digits of the angle.
constexpr double kRounding = 1e-15, kNearlyOpposite = 1e-7;

void expectLeastTurn(const Vector3d& from, const Vector3d& to, double accuracy) {
  const Eigen::Quaterniond turn = turnBetween(from, to);
  const Vector3d one = from.normalized(), other = to.normalized();
  EXPECT_NEAR(turn.norm(), 1.0, accuracy);
  EXPECT_LT((turn * one - other).norm(), accuracy)
      << one.transpose() << " to " << other.transpose();
  EXPECT_LT(std::abs(turn.vec().dot(one)), accuracy) << "not the least one";
}

TEST(TurnBetween, TakesAnyDirectionToAnyOtherOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const auto any = [&] { return Vector3d(share(random), share(random), share(random)); };
  for (int i = 0; i < 1000; ++i) expectLeastTurn(any(), any(), 1e-12);
}

TEST(TurnBetween, FindsAnAxisBetweenOppositeDirections) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d from(share(random), share(random), share(random));
    const Vector3d aside(share(random), share(random), share(random));
    expectLeastTurn(from, -from, kNearlyOpposite);
    expectLeastTurn(from, -3.0 * from + 1e-8 * share(random) * aside, kNearlyOpposite);
  }
  // So far from opposite that the cosine says the angle, and the axis has to be that of both.
  for (int i = 0; i < 1000; ++i) {
    const Vector3d from = Vector3d(share(random), share(random), share(random)).normalized();
    const double off = 2e-7 + 8e-7 * std::abs(share(random));
    expectLeastTurn(from, -from + off * from.unitOrthogonal(), 1e-8);
  }
  for (int axis = 0; axis < 3; ++axis) {
    expectLeastTurn(Vector3d::Unit(axis), -Vector3d::Unit(axis), kRounding);
  }
}

TEST(TurnBetween, SameDirectionNeedsNoTurn) {
  EXPECT_EQ(turnBetween(2.0 * Vector3d::UnitY(), Vector3d::UnitY()).vec().norm(), 0.0);
}

}  // namespace
}  // namespace foretouch
