// lss/separation.h: proven bounds on the distance of a segment and a triangle, rounding included. A
// plane between two convex sets bounds their distance from below, a pair of points from above, and
// neither relies on the closest-point solver, which only proposes. Proof: docs/guarantees.md 3.
#pragma once

#include <Eigen/Core>

#include "lss/rounding.h"
#include "lss/segment_triangle.h"
#include "lss/triangle.h"

namespace foretouch {

/// Rounding of the plane's and the witnesses' arithmetic, relative to the sum of the extents
/// involved (docs/guarantees.md 3.2). Doubling it loses accuracy near 1e-14 m per metre; halving it
/// breaks the proof, but not yet the measured worst case (tests/lss/separation_test.cpp).
inline constexpr double kSeparationRounding = 16.0 * kUnitRoundoff;

namespace internal {
/// If the closest points are nearer than this fraction of the pair's extent, their difference is a
/// noisy direction, and we also try the features' own normal.
inline constexpr double kNoisyDirection = 1e-3;
}  // namespace internal

/// The proof for one segment and one triangle at one instant. Distances in metres. For every point
/// x of the segment a + s(b-a) and every point y of the triangle nhat.(x - y) >= (1-s)*clearanceA +
/// s*clearanceB, with |nhat| <= 1; so the distance is at least min(clearanceA, clearanceB), and at
/// most `upper`.
struct Separation {
  Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< From the triangle towards the segment.
  double clearanceA = 0.0, clearanceB = 0.0;       ///< Rounded down.
  double upper = 0.0;                              ///< Rounded up.
  ClosestPoints closest;

  [[nodiscard]] double lower() const { return clearanceA < clearanceB ? clearanceA : clearanceB; }
};

[[nodiscard]] Separation separation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Triangle& triangle);

}  // namespace foretouch
