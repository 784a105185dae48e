#include "middleware/pair/leaf_hits.h"

#include "middleware/lanes/lane_rows.h"

namespace foretouch::internal {

void LeafHits::sortByBox(std::size_t boxes) {
  first.assign(boxes + 2, 0);
  for (const LeafHit& hit : hits) ++first[hit.box + 2U];
  for (std::size_t i = 2; i < boxes + 2; ++i) first[i] += first[i - 1];
  leaf.resize(hits.size() + kMaxLanes);
  triangles.resize(hits.size());
  for (const LeafHit& hit : hits) {
    const std::uint32_t place = first[hit.box + 1U]++;
    leaf[place] = static_cast<std::int32_t>(hit.leaf);
    triangles[place] = hit.triangles;
  }
}

}  // namespace foretouch::internal
