// middleware/exact/side_of.h: on which side of a plane a point lies, and on which side of a line as
// seen along an axis: signs of determinants, exact. Doubles decide where their rounding cannot
// matter, integers the rest. All coordinates finite, |coordinate| <= 1e100. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "middleware/exact/scaled_integer.h"

namespace foretouch::internal {

using Exact = std::array<Integer, 3>;

/// Each axis by its own power of two: no sign below depends on it.
template <std::size_t N>
std::array<Exact, N> exactly(const std::array<const Eigen::Vector3d*, N>& points) {
  std::array<Exact, N> exact;
  for (int axis = 0; axis < 3; ++axis) {
    int lowest = kNoExponent;
    for (const auto* p : points) lowest = std::min(lowest, exponentOf((*p)[axis]));
    for (std::size_t i = 0; i < N; ++i) exact[i][axis] = scaled((*points[i])[axis], lowest);
  }
  return exact;
}

[[nodiscard]] inline int signOf(const Integer& value) {
  return value.sign();
}

/// The sign of det(b - a, c - a, d - a): the side of the plane a b c that d is on; 0 if the four
/// are in one plane.
[[nodiscard]] int sideOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// As seen along Z: the sign of (b - a) x (p - a), 1 if p is to the left of the line from a to b.
[[nodiscard]] int turnOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& p);

}  // namespace foretouch::internal
