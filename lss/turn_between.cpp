#include "lss/turn_between.h"

#include <algorithm>
#include <cmath>

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// How far the cosine is from -1 where a cross product gives the axis less and less precisely.
constexpr double kNearlyOpposite = 1e-12;

/// The unit vector across both, by Householder's reflections of the longer one and of what is left
/// of the other one.
Vector3d acrossBoth(const Vector3d& one, const Vector3d& other) {
  Eigen::Matrix<double, 3, 2> pair;
  pair << one, other;
  pair /= pair.cwiseAbs().maxCoeff();
  if (pair.col(1).norm() > pair.col(0).norm()) pair.col(0).swap(pair.col(1));
  Eigen::Vector2d first;
  Eigen::Matrix<double, 1, 1> second;
  double firstFactor = 0.0, secondFactor = 0.0, length = 0.0, scratch = 0.0;
  pair.col(0).makeHouseholder(first, firstFactor, length);
  pair.col(1).applyHouseholderOnTheLeft(first, firstFactor, &scratch);
  pair.col(1).tail<2>().makeHouseholder(second, secondFactor, length);
  Vector3d across = Vector3d::UnitZ();
  across.tail<2>().applyHouseholderOnTheLeft(second, secondFactor, &scratch);
  across.applyHouseholderOnTheLeft(first, firstFactor, &scratch);
  return across;
}

}  // namespace

Eigen::Quaterniond turnBetween(const Vector3d& from, const Vector3d& to) {
  const Vector3d one = from.normalized(), other = to.normalized();
  const double cosine = std::max(other.dot(one), -1.0);
  Eigen::Quaterniond turn;
  if (cosine < -1.0 + kNearlyOpposite) {
    const double squared = (1.0 + cosine) * 0.5;
    turn.w() = std::sqrt(squared);
    turn.vec() = acrossBoth(one, other) * std::sqrt(1.0 - squared);
  } else {
    const double twice = std::sqrt((1.0 + cosine) * 2.0);
    turn.vec() = one.cross(other) * (1.0 / twice);
    turn.w() = twice * 0.5;
  }
  return turn;
}

}  // namespace foretouch
