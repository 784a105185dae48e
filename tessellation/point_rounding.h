// tessellation/point_rounding.h: how far the computed place of a link's point at the nodes of a
// span is from its true one. Derived in tessellation/lss_polynomials.md 2.
#pragma once

#include "articulated/chain_nodes.h"

namespace foretouch::internal {

/// Bound on |computed - true| at each node's instant, of a point taken relative to the origin of
/// the nodes and to a shift no longer than reach + 2*rho: linear in its distance rho from its
/// link's origin.
struct PointRoundings {
  double atOrigin, perLength;
};
[[nodiscard]] inline PointRoundings pointRoundings(const NodeBounds& bounds) {
  // In units of the roundoff: a matrix times a vector, and the sums.
  constexpr double kArm = 16.0 * 0x1p-53, kSum = 32.0 * 0x1p-53;
  return {bounds.positionRounding + kSum * bounds.reach, bounds.rotationRounding + kArm + kSum};
}

/// The same for one point.
[[nodiscard]] inline double pointRounding(const ChainNodes& nodes, LinkId, double rho) {
  const PointRoundings roundings = pointRoundings(nodes.bounds());
  return roundings.atOrigin + roundings.perLength * rho;
}

/// The nearest float of this is not below `x`, nor that of -outward(-x) above it.
[[nodiscard]] inline double outward(double x) {
  constexpr double kFloatSpacing = 0x1p-23;  // twice what rounding to nearest can take off
  constexpr double kUnderflow = 1e-40;       // floats below 1e-38 are spaced by 1.4e-45
  return x + (x < 0.0 ? -x : x) * kFloatSpacing + kUnderflow;
}

[[nodiscard]] inline float floatAbove(double x) {
  return static_cast<float>(outward(x));
}

}  // namespace foretouch::internal
