// tests/reference/filter_corners.h: the quantities of a moving polygon that the filter
// computes in doubles, and how far each may be off. Proof:
// tests/reference/linear_query.md 3; tests/middleware/reference/filter_rounding_test.cpp
// checks it with fifty digits.
#pragma once

#include <array>

#include <Eigen/Core>

#include "lss/separation.h"
#include "tests/reference/cubic.h"
#include "tests/reference/moving_polygon.h"

namespace foretouch::internal {

/// Rounding relative to the largest value that the extents allow: of the coefficients of f, of one
/// halving, of f's value at an instant, of a side's value at an instant, of a corner's dot product
/// with a direction. Counted in linear_query.md 3; halving any of them breaks the proof.
inline constexpr double kVolumeRounding = 16.0 * kUnitRoundoff;
inline constexpr double kHalvingRounding = 4.0 * kUnitRoundoff;
inline constexpr double kValueRounding = 16.0 * kUnitRoundoff;
inline constexpr double kSideRounding = 16.0 * kUnitRoundoff;
inline constexpr double kCornerPlaneRounding = 12.0 * kUnitRoundoff;

struct Corners {
  std::array<Eigen::Vector3d, 4> from, to;
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  // of each axis: the largest |component|
  int count = 0;

  [[nodiscard]] int next(int i) const { return i + 1 == count ? 0 : i + 1; }
  /// The largest value of f, and of component u x v of a cross product, that the extents allow.
  [[nodiscard]] double largestVolume() const { return 18.0 * extent.x() * extent.y() * extent.z(); }
  [[nodiscard]] double largestSide(int u, int v) const { return 2.0 * extent[u] * extent[v]; }
};

[[nodiscard]] Corners cornersOf(const MovingPolygon& polygon);

/// f: three times the Bernstein coefficients of det(corner 0, corner 1, corner 2).
[[nodiscard]] Cubic volumeOf(const Corners& c);

/// Component u x v of corner j x corner j+1: first (1-t)^2 + twiceMiddle (1-t) t + last t^2.
struct CornerSide {
  double first, twiceMiddle, last;
};
[[nodiscard]] CornerSide sideOf(const Corners& c, int j, int u, int v);
[[nodiscard]] inline double valueAt(const CornerSide& side, double t) {
  const double s = 1.0 - t;
  return s * s * side.first + s * t * side.twiceMiddle + t * t * side.last;
}

}  // namespace foretouch::internal
