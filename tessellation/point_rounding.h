// tessellation/point_rounding.h: how far the computed place of a link's point at the nodes of a
// span is from its true one. Derived in tessellation/lss_polynomials.md 2.
#pragma once

#include "articulated/chain_nodes.h"
#include "lss/rounding.h"

namespace foretouch::internal {

/// Bound on |computed - true| at each node's instant, for a point relative to the origin of the
/// nodes and to a shift no longer than reach + 2*rho: linear in its distance rho from its link's
/// origin.
struct PointRoundings {
  double atOrigin, perLength;
};
[[nodiscard]] inline PointRoundings pointRoundings(const NodeBounds& bounds) {
  // In units of the roundoff: a matrix times a vector, and the sums.
  constexpr double kArm = 16.0 * kUnitRoundoff, kSum = 32.0 * kUnitRoundoff;
  return {bounds.positionRounding + kSum * bounds.reach, bounds.rotationRounding + kArm + kSum};
}

/// The same for one point.
[[nodiscard]] inline double pointRounding(const NodeBounds& bounds, double rho) {
  const PointRoundings roundings = pointRoundings(bounds);
  return roundings.atOrigin + roundings.perLength * rho;
}

}  // namespace foretouch::internal
