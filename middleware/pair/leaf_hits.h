// middleware/pair/leaf_hits.h: what a walk of the scene's tree found near many boxes, box by box.
// Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "middleware/scene/flat_bvh_lanes.h"

namespace foretouch::internal {

struct LeafHits {
  std::vector<LeafHit> hits;  // of all boxes, in the order of the walk
  // The hits by box; `first`: where those of a box begin.
  std::vector<std::uint32_t> first;
  std::vector<std::int32_t> leaf;  // padded by kMaxLanes
  std::vector<std::uint8_t> triangles;

  /// Sorts by box, otherwise in the order of the walk (counting sort).
  void sortByBox(std::size_t boxes);
};

}  // namespace foretouch::internal
