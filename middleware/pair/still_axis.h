// middleware/pair/still_axis.h: an LSS of one link at one instant, in the frame of another link
// that has a mesh: its parts need not be placed there. Not installed.
#pragma once

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/lanes/axis_parts.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// `own`, `bounds`: those of the link that has the LSS; `mesh`, `boundsOfMesh`: of the one that has
/// the mesh. Both in one frame.
[[nodiscard]] StillAxis stillAxis(const Lss& lss, const LinkState& own, const AxisBounds& bounds,
                                  const LinkState& mesh, const MotionBounds& boundsOfMesh);

}  // namespace foretouch::internal
