#include "middleware/reference/point_query_culler.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// Float has 24 bits: a vertex or the sphere's centre moves by at most 2^-24 of its coordinate per
/// axis, and the squared distance is off by a few 2^-23 of itself. Ten times that, on both.
constexpr double kFloatSlack = 2e-6;

struct Collected {
  const std::vector<TriangleId>* idOf;
  std::vector<TriangleId>* ids;
  std::uint64_t visited = 0;
};

bool collectPrimitive(RTCPointQueryFunctionArguments* arguments) {
  auto& collected = *static_cast<Collected*>(arguments->userPtr);
  collected.ids->push_back((*collected.idOf)[arguments->primID]);
  ++collected.visited;
  return false;  // the radius stays
}

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

PointQueryCuller::PointQueryCuller(const Scene& scene, const EmbreeTriangles& triangles)
    : scene_(scene), triangles_(triangles), places_(scene.numTriangles()) {
  const FlatBvh& bvh = scene.parts().bvh;
  for (std::uint32_t i = 0; i < bvh.numLeaves(); ++i) {
    const BvhLeaf& leaf = bvh.leaf(i);
    for (int k = 0; k < leaf.count(); ++k) {
      places_[slotOf(leaf.id[k])] = {i, static_cast<std::uint8_t>(1U << k)};
    }
  }
}

Result<std::shared_ptr<const PointQueryCuller>> PointQueryCuller::build(const Scene& scene) {
  FORETOUCH_TRY(const auto triangles, scene.parts().embreeTriangles());
  return std::shared_ptr<const PointQueryCuller>(new PointQueryCuller(scene, *triangles));
}

void PointQueryCuller::collect(const Aabb& box, std::vector<TriangleId>& ids,
                               std::uint64_t& visited) const {
  const SceneParts& parts = scene_.parts();
  const Eigen::Vector3d center = 0.5 * (box.min + box.max) - parts.origin;
  const double radius = 0.5 * (box.max - box.min).norm();
  const double coordinates = std::max(triangles_.extent(), center.cwiseAbs().maxCoeff());
  RTCPointQuery query;
  query.x = static_cast<float>(center.x());
  query.y = static_cast<float>(center.y());
  query.z = static_cast<float>(center.z());
  query.time = 0.0f;
  query.radius = floatAbove(radius * (1.0 + kFloatSlack) + coordinates * kFloatSlack);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Collected collected{&parts.finiteIds, &ids, 0};
  rtcPointQuery(triangles_.scene(), &query, &context, collectPrimitive, &collected);
  visited += collected.visited;
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
