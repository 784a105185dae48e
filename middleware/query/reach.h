// middleware/query/reach.h: is any triangle of the scene where the avatar could be at all? Sweeps a
// ball as wide as the body is long along each root's straight path; needs no frames. Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/query_counters.h"
#include "middleware/scene/scene.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// True: every LSS stays farther than `tolerance` from every triangle at every t, however the
/// joints turn; so at link or exact fidelity every link is clear. O(roots), and one walk of the
/// tree that ends at the first leaf.
[[nodiscard]] bool nothingInReach(const LssTable& table, const ChainMotion& motion,
                                  const Scene& scene, double tolerance, QueryCounters& counters);

}  // namespace foretouch::internal
