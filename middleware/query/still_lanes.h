// middleware/query/still_lanes.h: an LSS of one link against parts of another link's mesh, all at
// one instant: sixteen pairs at a time, in the mesh's own frame, where its parts need not be
// placed. Not installed.
#pragma once

#include <cstddef>

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/lanes/frame_lanes.h"
#include "middleware/lanes/triangle_pairs.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// An LSS at one instant, seen from a link with a mesh (m).
struct StillAxis {
  float point[2][3];
  float radius;  ///< Rounded up.
  /// What places of the axis, and of a point of the mesh at distance rho from its link's origin,
  /// are off by: at most pad + padPerRho * rho. Rounded up.
  float pad, padPerRho;
};

/// `own`, `bounds`: of the link that has the LSS; `mesh`, `boundsOfMesh`: of the link that has the
/// mesh. Both in one frame.
[[nodiscard]] StillAxis stillAxis(const Lss& lss, const LinkState& own, const AxisBounds& bounds,
                                  const LinkState& mesh, const MotionBounds& boundsOfMesh);

/// For one thread.
class StillLanes {
 public:
  void put(std::size_t lane, const StillAxis& axis, const LanePart& part);
  /// Proves the first `count` lanes.
  void prove(std::size_t count) { proveSegmentSteps(pairs_, count, steps_); }
  /// The lane's pair is at least so far apart (m); not above 0 if nothing is proven.
  [[nodiscard]] double lower(std::size_t lane) const {
    return static_cast<double>(steps_.lower[lane]) - radii_[lane];
  }

 private:
  TrianglePairBlock pairs_{};  // at rest
  TrianglePairSteps steps_{};
  double radii_[kTrianglePairLanes] = {};
};

}  // namespace foretouch::internal
