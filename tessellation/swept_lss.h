// tessellation/swept_lss.h: the space that an LSS covers while its link moves, as certified boxes
// of pieces. Over a span of length h a point with |acceleration| <= A stays within A*h^2/8 of its
// chord, so the swept LSS lies in the hull of its axis ends at both instants, grown by radius +
// A*h^2/8. Derivation: docs/guarantees.md 4; [Kim07] tessellates the swept LSS likewise. Metres,
// world W. Not installed.
#pragma once

#include <Eigen/Core>

#include "articulated/motion.h"
#include "lss/lss.h"
#include "tessellation/aabb.h"

namespace foretouch {

/// The ends of an LSS's axis in W at one instant, as computed.
struct AxisEnds {
  Eigen::Vector3d a, b;
};

[[nodiscard]] inline AxisEnds axisEnds(const Lss& lss_L, const LinkState& state) {
  return {state.pointAt(lss_L.a), state.pointAt(lss_L.b)};
}

/// Bounds on the two ends of one LSS's axis, at every t in [0,1].
struct AxisBounds {
  double accelerationA = 0.0, accelerationB = 0.0;
  double speed = 0.0;  ///< The larger of the two ends'.
  double positionRoundingA = 0.0, positionRoundingB = 0.0;
  double velocityRoundingA = 0.0, velocityRoundingB = 0.0;
};

[[nodiscard]] AxisBounds axisBounds(const Lss& lss_L, const MotionBounds& bounds);

/// A box that contains the LSS at every t of a span, grown by `margin`; rounds outward. `begin` and
/// `end` are the computed axis ends at both instants, `span` their distance in t.
[[nodiscard]] Aabb sweptBox(const Lss& lss_L, const AxisBounds& bounds, const AxisEnds& begin,
                            const AxisEnds& end, double span, double margin);

}  // namespace foretouch
