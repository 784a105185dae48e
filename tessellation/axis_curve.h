// tessellation/axis_curve.h: the motion of an LSS's axis over a span as polynomials in double, in W
// or in the frame of a link above it: places and velocities at any instant without trigonometry.
// Every error is proved in tessellation/lss_polynomials.md 5 and reported. Metres, derivatives by
// t. Not installed.
#pragma once

#include <Eigen/Core>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "tessellation/lss_table.h"

namespace foretouch {

/// Promise: at every t of the span both true ends are within `error` of the polynomials as
/// evaluated by endsAt(), whose true derivatives are within `velocityRounding` of its velocities
/// and bounded by the accelerations throughout the span.
struct AxisCurve {
  static constexpr int kRows = 8;  ///< x, y, z of both ends, and two of zeros.

  struct Ends {
    Eigen::Vector3d a, b, velocityA, velocityB;
  };
  [[nodiscard]] Ends endsAt(double t) const;

  alignas(64) double coefficients[kNodes][kRows];  ///< For powers of x in [-1,1].
  double begin, toX;                               ///< x = (t - begin) toX - 1.
  double error, velocityRounding, accelerationA, accelerationB;
};

/// `bounds` are those of the entry's link in the frame. `frame` has the frame's nodes; null for W,
/// relative to the nodes' origin.
[[nodiscard]] AxisCurve axisCurve(const LssTable::Entry& entry, const MotionBounds& bounds,
                                  const ChainNodes& nodes, const LinkNodes* frame);

}  // namespace foretouch
