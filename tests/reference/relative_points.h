// tests/reference/relative_points.h: positions of other links' points in a carrier's frame at the
// nodes of a span, in the processor's lanes. Metres.
#pragma once

#include "articulated/chain_nodes.h"

namespace foretouch::internal {

/// One point in the carrier's frame, at all nodes.
struct alignas(64) RelativePoint {
  double y[3][kNodes];
};

/// Fills `point` for the point `p_L` of `link`. Rounding: tests/reference/rungs.md 3.
void relativePoint(const LinkNodes& carrier, const LinkNodes& link, const double* p_L,
                   RelativePoint& point);

/// A segment, as a, b - a and 1/|b - a|^2 (0 if that is infinite: then only a counts).
struct AxisSegment {
  double a[3], u[3], inverse;
};

/// Squares of lengths (m^2): the largest distance of the point from the segment over the nodes, and
/// from the carrier's origin.
struct LargestSquares {
  double fromAxis, fromOrigin;
};
[[nodiscard]] LargestSquares largestSquares(const RelativePoint& point, const AxisSegment& axis);

}  // namespace foretouch::internal
