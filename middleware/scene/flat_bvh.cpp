#include "middleware/scene/flat_bvh.h"

#include "lss/assert.h"
#include "middleware/scene/eight_boxes.h"

namespace foretouch::internal {
namespace {

/// A walk of one box, depth first, keeps at most this many nodes.
constexpr std::size_t kStackSize = kBvhWidth * (kMaxBvhDepth + 1);

void collectLeaf(const BvhLeaf& leaf, const LocalBox& box, std::vector<TriangleId>& ids) {
  const Eight eight = trianglesOverlapping(leaf, box);
  for (int i = 0; i < kBvhWidth && leaf.id[i] >= 0; ++i) {
    if (eight.overlaps[i] != 0) ids.push_back(leaf.id[i]);
  }
}

/// Every leaf whose box overlaps, until one is enough: then true.
template <typename OnLeaf>
bool walk(const FlatBvh::Arrays& arrays, const LocalBox& local, std::uint64_t& visited,
          const OnLeaf& isEnough) {
  std::uint32_t stack[kStackSize];
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const BvhNode& node = arrays.nodes[stack[--size]];
    ++visited;
    const Eight eight = eightOverlapping(node.lower, node.upper, local);
    for (int i = 0; i < kBvhWidth; ++i) {
      if (eight.overlaps[i] == 0) continue;
      const std::uint32_t child = node.child[i];
      if ((child & BvhNode::kLeafFlag) != 0) {
        if (isEnough(arrays.leaves[child & BvhNode::kLeafMask])) return true;
      } else {
        FORETOUCH_ASSERT(size < kStackSize);
        stack[size++] = child;
      }
    }
  }
  return false;
}

}  // namespace

void FlatBvh::collect(const Aabb& box, std::vector<TriangleId>& ids, std::uint64_t& visited) const {
  const LocalBox local = localBox(box, origin_);
  (void)walk(arrays_, local, visited, [&](const BvhLeaf& leaf) {
    collectLeaf(leaf, local, ids);
    return false;
  });
}

bool FlatBvh::meetsLeaf(const Aabb& box, std::uint64_t& visited) const {
  return walk(arrays_, localBox(box, origin_), visited, [](const BvhLeaf&) { return true; });
}

void FlatBvh::collectLeaves(const BoxLanes& boxes, std::vector<LeafHit>& hits,
                            std::uint64_t& nodesVisited, std::uint64_t& leavesVisited) const {
  FORETOUCH_ASSERT(boxes.count >= 0 && boxes.count <= BoxLanes::kMaxBoxes);
  BvhWalk walk;
  walk.nodes = arrays_.nodes.data();
  walk.clusters = arrays_.clusters.data();
  for (int first = 0; first < boxes.count; first += kBoxGroup) {
    beginWalk(walk, boxes, first);
    while (!walk.finished()) {
      continueWalk(walk);
      hits.insert(hits.end(), walk.hit, walk.hit + walk.hitCount);
    }
    nodesVisited += walk.nodesVisited;
    leavesVisited += walk.leavesVisited;
  }
}

}  // namespace foretouch::internal
