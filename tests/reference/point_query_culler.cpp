// What every way of collecting has in common; the ways: point_query_embree.cpp, and where Embree is
// not, point_query_plain.cpp.
#include "tests/reference/point_query_culler.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lss/index.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// One hit per leaf and box.
void mergeHits(std::vector<LeafHit>& hits) {
  std::sort(hits.begin(), hits.end(), [](const LeafHit& x, const LeafHit& y) {
    return std::tie(x.box, x.leaf) < std::tie(y.box, y.leaf);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (kept > 0 && hits[kept - 1].box == hits[i].box && hits[kept - 1].leaf == hits[i].leaf) {
      hits[kept - 1].triangles |= hits[i].triangles;
    } else {
      hits[kept++] = hits[i];
    }
  }
  hits.resize(kept);
}

/// In the world; empty if the i-th box is.
Aabb boxAt(const BoxLanes& boxes, int i, const Eigen::Vector3d& origin) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = origin[axis] + static_cast<double>(boxes.lower[axis][i]);
    box.max[axis] = origin[axis] + static_cast<double>(boxes.upper[axis][i]);
  }
  return box;
}

}  // namespace

PointQueryCuller::PointQueryCuller(const Scene& scene,
                                   std::shared_ptr<const EmbreeTriangles> triangles)
    : scene_(scene), triangles_(std::move(triangles)), places_(scene.numTriangles()) {
  const FlatBvh& bvh = scene.parts().bvh;
  for (std::uint32_t i = 0; i < bvh.numLeaves(); ++i) {
    const BvhLeaf& leaf = bvh.leaf(i);
    for (int k = 0; k < leaf.count(); ++k) {
      places_[slotOf(leaf.id[k])] = {i, static_cast<std::uint8_t>(1U << k)};
    }
  }
}

void PointQueryCuller::collectLeaves(const BoxLanes& boxes, std::vector<LeafHit>& hits,
                                     std::uint64_t& nodesVisited,
                                     std::uint64_t& /*leavesVisited*/) const {
  std::vector<TriangleId> found;
  for (int i = 0; i < boxes.count; ++i) {
    Aabb box = boxAt(boxes, i, scene_.parts().origin);
    if (!(box.min.x() <= box.max.x())) continue;
    box.grow(0.0);
    found.clear();
    collect(box, found, nodesVisited);
    for (const TriangleId id : found) {
      const Place& place = places_[slotOf(id)];
      hits.push_back({place.leaf, static_cast<std::uint16_t>(i), place.triangle});
    }
  }
  mergeHits(hits);
}

}  // namespace foretouch::internal
