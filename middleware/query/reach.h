// middleware/query/reach.h: is anything of the scene where the avatar could be at all? A ball as
// wide as the body is long around each root's straight way: no frames are needed. Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/query_counters.h"
#include "middleware/scene/scene.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// True: every LSS stays farther than `tolerance` from every triangle at every t, whatever turns;
/// so at link or exact fidelity every link is clear. O(roots), and one walk of the tree that ends
/// at the first leaf.
[[nodiscard]] bool nothingInReach(const LssTable& table, const ChainMotion& motion,
                                  const Scene& scene, double tolerance, QueryCounters& counters);

}  // namespace foretouch::internal
