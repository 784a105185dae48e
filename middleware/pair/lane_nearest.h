// middleware/pair/lane_nearest.h: what is near an LSS that stands still, asked of lanes. Not
// installed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "middleware/contact.h"
#include "middleware/lanes/near_triangles.h"
#include "middleware/pair/leaf_hits.h"
#include "middleware/scene/scene.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// Where the hits of one LSS lie.
struct HitRange {
  std::uint32_t begin, end;
};

/// Leaves in `near` those triangles of the hits that lanes cannot prove farther than
/// `reach` (m) from an LSS with this axis. The ends are taken for exact: their rounding is the
/// reach's.
void findNear(const Scene& scene, const AxisEnds& ends, double radius, double reach, HitRange range,
              const LeafHits& hits, NearTriangles& near, QueryCounters& counters);
/// The same for leaves by themselves: `leaf` can be read kMaxLanes beyond `count`.
void findNear(const Scene& scene, const AxisEnds& ends, double radius, double reach,
              const std::int32_t* leaf, const std::uint8_t* triangles, std::size_t count,
              NearTriangles& near);

}  // namespace foretouch::internal
