#include "middleware/bracket/link_leaves.h"

#include <algorithm>
#include <limits>

#include "middleware/lanes/lane_rows.h"
#include "middleware/pair/lane_nearest.h"
#include "middleware/scene/eight_boxes.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
void NearLeaves::add(std::int32_t one, std::uint8_t asked) {
  const std::size_t count = triangles.size();
  if (leaf.size() < count + 1 + kMaxLanes) leaf.resize(2 * (count + 1) + kMaxLanes);
  leaf[count] = one;
  triangles.push_back(asked);
}

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
                         NearLeaves& leaves) const {
  leaves.clear();
  for (std::uint32_t i = hits_.first[box]; i < hits_.first[box + 1]; ++i) {
    const BvhLeaf& leaf = scene.parts().bvh.leaf(static_cast<std::uint32_t>(hits_.leaf[i]));
    const std::uint8_t asked = withoutIgnored(hits_.triangles[i], leaf, scene, ignored);
    if (asked != 0) leaves.add(hits_.leaf[i], asked);
  }
}

void LinkLeaves::collect(const Scene& scene, const LinkTubes& tubes, const NearLeaves& leaves,
                         NearPairs& pairs) {
  pairs.clear();
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t lss = 0; lss < tubes.size(); ++lss) {
    if (leaves.empty() || tubes[lss].isNothing()) continue;
    findNear(scene, tubes[lss].axis(), tubes[lss].reach(), 0.0, leaves.leaf.data(),
             leaves.triangles.data(), leaves.size(), near_);
    for (std::size_t i = 0; i < near_.count; ++i) {
      pairs.push_back({{static_cast<std::int32_t>(lss), -1}, {-1, near_.id[i]}});
      if (near_.gap[i] >= least) continue;
      least = near_.gap[i];
      std::swap(pairs.front(), pairs.back());
    }
  }
}

}  // namespace foretouch::internal
