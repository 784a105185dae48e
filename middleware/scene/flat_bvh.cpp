#include "middleware/scene/flat_bvh.h"

#include "lss/assert.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// A walk of one box, depth first, keeps at most this many nodes.
constexpr std::size_t kStackSize = kBvhWidth * (kMaxBvhDepth + 1);

struct FloatBox {
  float lower[3], upper[3];
};

FloatBox localBox(const Aabb& box, const Eigen::Vector3d& origin) {
  FloatBox local;
  for (int axis = 0; axis < 3; ++axis) {
    local.lower[axis] = floatBelow(box.min[axis] - origin[axis]);
    local.upper[axis] = floatAbove(box.max[axis] - origin[axis]);
  }
  return local;
}

/// One flag per box of eight, without branches, so that the compiler can vectorise.
struct Eight {
  std::uint8_t overlaps[kBvhWidth];
};

Eight eightOverlapping(const float (&lower)[3][kBvhWidth], const float (&upper)[3][kBvhWidth],
                       const FloatBox& box) {
  Eight eight;
  for (int i = 0; i < kBvhWidth; ++i) {
    const auto atMost = [](float x, float y) { return static_cast<unsigned>(x <= y); };
    eight.overlaps[i] = static_cast<std::uint8_t>(
        atMost(lower[0][i], box.upper[0]) & atMost(box.lower[0], upper[0][i]) &
        atMost(lower[1][i], box.upper[1]) & atMost(box.lower[1], upper[1][i]) &
        atMost(lower[2][i], box.upper[2]) & atMost(box.lower[2], upper[2][i]));
  }
  return eight;
}

void collectLeaf(const BvhLeaf& leaf, const FloatBox& box, std::vector<TriangleId>& ids) {
  float lower[3][kBvhWidth], upper[3][kBvhWidth];
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kBvhWidth; ++i) {
      const float a = leaf.vertex[0][axis][i];
      const float b = leaf.vertex[1][axis][i];
      const float c = leaf.vertex[2][axis][i];
      const float lessOfAb = a < b ? a : b;
      const float moreOfAb = a > b ? a : b;
      lower[axis][i] = lessOfAb < c ? lessOfAb : c;
      upper[axis][i] = moreOfAb > c ? moreOfAb : c;
    }
  }
  const Eight eight = eightOverlapping(lower, upper, box);
  for (int i = 0; i < kBvhWidth && leaf.id[i] >= 0; ++i) {
    if (eight.overlaps[i] != 0) ids.push_back(leaf.id[i]);
  }
}

}  // namespace

void FlatBvh::collect(const Aabb& box, std::vector<TriangleId>& ids, std::uint64_t& visited) const {
  const FloatBox local = localBox(box, origin_);
  std::uint32_t stack[kStackSize];
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const BvhNode& node = arrays_.nodes[stack[--size]];
    ++visited;
    const Eight eight = eightOverlapping(node.lower, node.upper, local);
    for (int i = 0; i < kBvhWidth; ++i) {
      if (eight.overlaps[i] == 0) continue;
      const std::uint32_t child = node.child[i];
      if ((child & BvhNode::kLeafFlag) != 0) {
        collectLeaf(arrays_.leaves[child & BvhNode::kLeafMask], local, ids);
      } else {
        FORETOUCH_ASSERT(size < kStackSize);
        stack[size++] = child;
      }
    }
  }
}

bool FlatBvh::meetsLeaf(const Aabb& box, std::uint64_t& visited) const {
  const FloatBox local = localBox(box, origin_);
  std::uint32_t stack[kStackSize];
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const BvhNode& node = arrays_.nodes[stack[--size]];
    ++visited;
    const Eight eight = eightOverlapping(node.lower, node.upper, local);
    for (int i = 0; i < kBvhWidth; ++i) {
      if (eight.overlaps[i] == 0) continue;
      const std::uint32_t child = node.child[i];
      if ((child & BvhNode::kLeafFlag) != 0) return true;
      FORETOUCH_ASSERT(size < kStackSize);
      stack[size++] = child;
    }
  }
  return false;
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
