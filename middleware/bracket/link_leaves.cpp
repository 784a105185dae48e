#include "middleware/bracket/link_leaves.h"

#include <algorithm>

#include "lss/rounding.h"
#include "middleware/scene/eight_boxes.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

SweptTube::Ball ballOf(const FlatBvh& bvh, std::uint32_t leaf) {
  const Cluster& cluster = bvh.cluster(leaf);
  return {bvh.origin() + Eigen::Map<const Eigen::Vector3f>(cluster.centre).cast<double>(),
          static_cast<double>(cluster.radius)};
}

template <typename Visit>
void forEachAsked(const FlatBvh& bvh, const NearLeaf& near, const Visit& visit) {
  const BvhLeaf& leaf = bvh.leaf(near.leaf);
  for (unsigned slot = 0; slot < kBvhWidth; ++slot) {
    if ((near.triangles >> slot & 1U) != 0) visit(slot, leaf.id[slot]);
  }
}

}  // namespace

void LinkLeaves::setLanes(const Scene& scene, const std::vector<Aabb>& boxes) {
  const Eigen::Vector3d& origin = scene.parts().origin;
  lanes_.resize(static_cast<std::int32_t>(boxes.size()));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const LocalBox box = localBox(boxes[i], origin);
    for (int axis = 0; axis < 3; ++axis) {
      lanes_.lower[axis][i] = box.lower[axis];
      lanes_.upper[axis][i] = box.upper[axis];
    }
  }
}

void LinkLeaves::walk(const Scene& scene, const std::vector<Aabb>& boxes) {
  setLanes(scene, boxes);
  BoxLanes lanes;
  lanes.count = lanes_.count;
  for (int axis = 0; axis < 3; ++axis) {
    lanes.lower[axis] = lanes_.lower[axis];
    lanes.upper[axis] = lanes_.upper[axis];
  }
  hits_.hits.clear();
  std::uint64_t nodes = 0, leaves = 0;
  scene.parts().bvh.collectLeaves(lanes, hits_.hits, nodes, leaves);
  hits_.sortByBox(boxes.size());
}

void LinkLeaves::collect(const Scene& scene, std::size_t box, const IgnoredObjects& ignored,
                         const LinkTubes& tubes, std::size_t numLss, NearLeaves& leaves) const {
  const FlatBvh& bvh = scene.parts().bvh;
  leaves.clear();
  const std::uint32_t begin = hits_.first[box], end = hits_.first[box + 1];
  for (std::size_t lss = 0; lss < numLss; ++lss) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const auto leaf = static_cast<std::uint32_t>(hits_.leaf[i]);
      if (!tubes.empty() && !tubes[lss].mayMeet(ballOf(bvh, leaf))) continue;
      const std::uint8_t asked = withoutIgnored(hits_.triangles[i], bvh.leaf(leaf), scene, ignored);
      if (asked != 0) leaves.push_back({static_cast<std::int32_t>(lss), leaf, asked});
    }
  }
}

void LinkLeaves::narrow(const Scene& scene, const LinkTubes& tubes, const NearLeaves& leaves,
                        NearLeaves& fewer) {
  const FlatBvh& bvh = scene.parts().bvh;
  fewer.clear();
  for (const NearLeaf& near : leaves) {
    if (tubes[slotOf(near.lss)].mayMeet(ballOf(bvh, near.leaf))) fewer.push_back(near);
  }
}

void LinkLeaves::collect(const Scene& scene, const LinkTubes& tubes, const NearLeaves& leaves,
                         NearPairs& pairs) {
  const FlatBvh& bvh = scene.parts().bvh;
  pairs.clear();
  double least = kInfinity;
  std::int32_t lss = -1;
  LocalBox box{};
  for (const NearLeaf& near : leaves) {
    const SweptTube& tube = tubes[slotOf(near.lss)];
    if (near.lss != lss) box = localBox(tube.box(), bvh.origin());
    lss = near.lss;
    const Eight eight = trianglesOverlapping(bvh.leaf(near.leaf), box);
    forEachAsked(bvh, near, [&](unsigned slot, TriangleId id) {
      if (eight.overlaps[slot] == 0) return;
      const auto distance = tube.distanceTo(scene.triangle(id));
      if (!distance) return;
      pairs.push_back({{near.lss, -1}, {-1, id}});
      if (*distance >= least) return;
      least = *distance;
      std::swap(pairs.front(), pairs.back());
    });
  }
}

SidesPair LinkLeaves::nearest(const Scene& scene, const LinkTubes& tubes,
                              const NearLeaves& leaves) {
  const FlatBvh& bvh = scene.parts().bvh;
  const NearLeaf* best = nullptr;
  double least = kInfinity;
  for (const NearLeaf& near : leaves) {
    const SweptTube& tube = tubes[slotOf(near.lss)];
    const SweptTube::Ball ball = ballOf(bvh, near.leaf);
    const double distance = tube.distanceTo(ball);
    if (distance >= least || !tube.mayMeet(ball)) continue;
    least = distance;
    best = &near;
  }
  SidesPair nearest;
  if (best == nullptr) return nearest;
  least = kInfinity;
  forEachAsked(bvh, *best, [&](unsigned, TriangleId id) {
    const auto distance = tubes[slotOf(best->lss)].distanceTo(scene.triangle(id));
    if (!distance || *distance >= least) return;
    least = *distance;
    nearest = {{best->lss, -1}, {-1, id}};
  });
  return nearest;
}

}  // namespace foretouch::internal
