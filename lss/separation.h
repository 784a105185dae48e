// lss/separation.h: the convex hull of two or three points (an LSS's axis, or a triangle), and
// proven bounds on the distance of two hulls, rounding included. A plane between two convex sets
// bounds their distance from below, a pair of points from above, and neither relies on the
// closest-point solver, which only proposes. Metres. Proof: docs/guarantees.md 3.
#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "lss/lss.h"
#include "lss/rounding.h"

namespace foretouch {

/// Points that coincide are legal: a segment without length is a point.
struct Hull {
  std::array<Eigen::Vector3d, 3> points;  ///< The first `count` mean something.
  int count = 2;                          ///< 2 or 3.

  [[nodiscard]] static Hull segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return {{a, b, b}, 2};
  }
  [[nodiscard]] static Hull of(const Triangle& triangle) { return {triangle.vertices, 3}; }
  [[nodiscard]] Triangle triangle() const { return {points}; }
};

/// Rounding of the plane's and the witnesses' arithmetic, relative to the sum of the extents
/// involved (docs/guarantees.md 3). Doubling it loses accuracy near 1e-14 m per metre; halving it
/// breaks the proof, but not yet the measured worst case (tests/lss/separation_test.cpp).
inline constexpr double kSeparationRounding = 16.0 * kUnitRoundoff;

namespace internal {
/// If the closest points are nearer than this fraction of the pair's extent, their difference is a
/// noisy direction, and we also try the features' own normal.
inline constexpr double kNoisyDirection = 1e-3;
}  // namespace internal

/// The proof for two hulls at one instant. Distances in metres. For every point x = sum w_i x_i of
/// `one` and every point y = sum v_j y_j of `other`, nhat.(x - y) >= sum w_i v_j clearance(i, j),
/// with |nhat| <= 1; so their distance is at least the least clearance, and at most `upper`.
struct Separation {
  Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< From `other` towards `one`.
  /// How far each point of `one` is above all of `other`; rounded down.
  std::array<double, 3> clearance{};
  /// How much more each point of `other` leaves, >= 0.
  std::array<double, 3> spare{};
  double upper = 0.0;  ///< Rounded up.
  /// The closest points found. Both lie in their hulls up to rounding.
  Eigen::Vector3d onOne = Eigen::Vector3d::Zero(), onOther = Eigen::Vector3d::Zero();
  /// onOne - onOther before the far origin is added back, and its length; 0, up to rounding, if the
  /// hulls meet.
  Eigen::Vector3d difference = Eigen::Vector3d::Zero();
  double distance = 0.0;
  Eigen::Vector3d featureNormal = Eigen::Vector3d::Zero();  ///< As ClosestPoints::featureNormal.
  int numOne = 0, numOther = 0;                             ///< Their points.

  [[nodiscard]] double lower() const {
    const double least = std::min(clearance[0], clearance[1]);
    return numOne == 3 ? std::min(least, clearance[2]) : least;
  }
};

/// All coordinates finite, below 1e100.
[[nodiscard]] Separation separation(const Hull& one, const Hull& other);

}  // namespace foretouch
