// middleware/query/lane_nearest.h: what is near a link where it is in contact, asked of lanes as if
// nothing moved. Not installed.
#pragma once

#include <cstdint>

#include "middleware/query/lane_scratch.h"
#include "middleware/query_counters.h"
#include "middleware/scene/scene.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// Where the hits of one LSS lie in the scratch.
struct HitRange {
  std::uint32_t begin, end;
};

/// Leaves in `scratch.near` those triangles of the hits that lanes cannot prove farther than
/// `reach` (m) from an LSS with this axis. The ends are taken for exact: their rounding is the
/// reach's.
void findNear(const Scene& scene, const AxisEnds& ends, double radius, double reach, HitRange hits,
              LaneScratch& scratch, QueryCounters& counters);

}  // namespace foretouch::internal
