#include "middleware/scene/flat_bvh_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/scene/flat_bvh_lanes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using BoxTag = hn::CappedTag<float, 16>;           // boxes in lanes
using ChildTag = hn::CappedTag<float, kBvhWidth>;  // children in lanes

// If more boxes than this per vector of boxes are alive, tests a node child by child with boxes in
// lanes; else box by box with children in lanes. Both give the same result: only speed depends on
// it.
constexpr int kAliveForBoxLanes = HWY_TARGET == HWY_SCALAR ? 0 : 1;

HWY_INLINE int lowestBit(std::uint64_t bits) {
  return static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
}

/// Bit i: lane i. At most 16 lanes, which Highway writes into two bytes.
template <class D>
HWY_INLINE std::uint64_t bitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | (static_cast<std::uint64_t>(bytes[1]) << 8);
}

/// Which of the closed boxes in the lanes meet one other box. Coordinates of an axis lie `kStride`,
/// those of the other box `kOtherStride` floats after the previous axis'.
template <int kStride, int kOtherStride, class D>
HWY_INLINE std::uint64_t lanesMeeting(D d, const float* lower, const float* upper,
                                      const float* otherLower, const float* otherUpper) {
  auto meet = hn::And(hn::Le(hn::Load(d, lower), hn::Set(d, otherUpper[0])),
                      hn::Ge(hn::Load(d, upper), hn::Set(d, otherLower[0])));
  for (int axis = 1; axis < 3; ++axis) {
    const int other = axis * kOtherStride;
    meet =
        hn::And(meet, hn::Le(hn::Load(d, lower + axis * kStride), hn::Set(d, otherUpper[other])));
    meet =
        hn::And(meet, hn::Ge(hn::Load(d, upper + axis * kStride), hn::Set(d, otherLower[other])));
  }
  return bitsOf(d, meet);
}

/// Which of eight boxes, children, meet one other box.
template <int kOtherStride>
HWY_INLINE unsigned eightMeeting(const float* lower, const float* upper, const float* otherLower,
                                 const float* otherUpper) {
  const ChildTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  unsigned meeting = 0;
  for (int i = 0; i < kBvhWidth; i += lanes) {
    meeting |= static_cast<unsigned>(lanesMeeting<kBvhWidth, kOtherStride>(d, lower + i, upper + i,
                                                                           otherLower, otherUpper))
               << i;
  }
  return meeting;
}

/// Which of the `alive` boxes meet child `child`.
HWY_INLINE std::uint64_t boxesMeeting(const BvhWalk& walk, const BvhNode& node, int child,
                                      std::uint64_t alive) {
  const BoxTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const std::uint64_t lanesMask = (std::uint64_t{1} << lanes) - 1;
  std::uint64_t meeting = 0;
  for (int v = 0; v < walk.vectorsOfBoxes; ++v) {
    const int first = v * lanes;
    if (((alive >> first) & lanesMask) == 0) continue;
    meeting |= lanesMeeting<kBoxGroup, kBvhWidth>(d, walk.lower[0] + first, walk.upper[0] + first,
                                                  node.lower[0] + child, node.upper[0] + child)
               << first;
  }
  return meeting & alive;
}

HWY_INLINE void prefetch(const void* object, int bytes) {
  constexpr int kCacheLine = 64;
  for (int byte = 0; byte < bytes; byte += kCacheLine) {
    hwy::Prefetch(static_cast<const char*>(object) + byte);
  }
}

/// Queues a child that the `alive` boxes meet, and prefetches it.
HWY_INLINE void push(BvhWalk& walk, std::uint32_t child, std::uint64_t alive) {
  if ((child & BvhNode::kLeafFlag) != 0) {
    walk.leaf[walk.leavesWaiting++] = {alive, child};
    prefetch(walk.clusters + (child & BvhNode::kLeafMask), sizeof(Cluster));
  } else {
    walk.waiting[walk.nodesWaiting++] = {alive, child};
    prefetch(walk.nodes + child, sizeof(BvhNode));
  }
}

HWY_INLINE void visitWithBoxLanes(BvhWalk& walk, const BvhNode& node, std::uint64_t alive) {
  unsigned children =
      eightMeeting<1>(node.lower[0], node.upper[0], walk.unionLower, walk.unionUpper);
  for (; children != 0; children &= children - 1) {
    const int child = lowestBit(children);
    const std::uint64_t meeting = boxesMeeting(walk, node, child, alive);
    if (meeting != 0) push(walk, node.child[child], meeting);
  }
}

HWY_INLINE void visitWithChildLanes(BvhWalk& walk, const BvhNode& node, std::uint64_t alive) {
  std::uint64_t meeting[kBvhWidth] = {};
  unsigned children = 0;
  for (; alive != 0; alive &= alive - 1) {
    const int box = lowestBit(alive);
    unsigned met = eightMeeting<kBoxGroup>(node.lower[0], node.upper[0], walk.lower[0] + box,
                                           walk.upper[0] + box);
    children |= met;
    for (; met != 0; met &= met - 1) meeting[lowestBit(met)] |= std::uint64_t{1} << box;
  }
  for (; children != 0; children &= children - 1) {
    const int child = lowestBit(children);
    push(walk, node.child[child], meeting[child]);
  }
}

/// Visits the waiting nodes, depth first, until the leaves fill their room.
HWY_INLINE void visitNodes(BvhWalk& walk) {
  while (walk.nodesWaiting > 0 && walk.leavesWaiting + kBvhWidth <= BvhWalk::kLeafRoom) {
    const BvhWalk::Entry next = walk.waiting[--walk.nodesWaiting];
    const BvhNode& node = walk.nodes[next.target];
    ++walk.nodesVisited;
    const auto alive = static_cast<int>(hwy::PopCount(next.alive));
    if (alive > kAliveForBoxLanes * walk.vectorsOfBoxes) {
      visitWithBoxLanes(walk, node, next.alive);
    } else {
      visitWithChildLanes(walk, node, next.alive);
    }
  }
}

/// Turns the waiting leaves into hits, until these fill their room.
HWY_INLINE void hitLeaves(BvhWalk& walk) {
  while (walk.leavesDone < walk.leavesWaiting && walk.hitCount + kBoxGroup <= BvhWalk::kHitRoom) {
    const BvhWalk::Entry entry = walk.leaf[walk.leavesDone++];
    const std::uint32_t index = entry.target & BvhNode::kLeafMask;
    const unsigned last = (entry.target & ~BvhNode::kLeafFlag) >> BvhNode::kCountShift;
    const auto triangles = static_cast<std::uint8_t>((2u << last) - 1);
    ++walk.leavesVisited;
    for (std::uint64_t alive = entry.alive; alive != 0; alive &= alive - 1) {
      const auto box = static_cast<std::uint16_t>(walk.firstBox + lowestBit(alive));
      walk.hit[walk.hitCount++] = {index, box, triangles};
    }
  }
  if (walk.leavesDone == walk.leavesWaiting) walk.leavesDone = walk.leavesWaiting = 0;
}

void continueWalkInLanes(BvhWalk& walk) {
  walk.hitCount = 0;
  visitNodes(walk);
  hitLeaves(walk);
}

/// Bounds of as many boxes as there are lanes, `missing` in lanes without a box.
template <class D>
HWY_INLINE hn::VFromD<D> loadBounds(D d, const float* bounds, int left, float missing) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  if (left >= lanes) return hn::LoadU(d, bounds);
  if constexpr (!HWY_MEM_OPS_MIGHT_FAULT) {
    const auto isThere = hn::FirstN(d, static_cast<std::size_t>(left));
    return hn::IfThenElse(isThere, hn::MaskedLoad(isThere, d, bounds), hn::Set(d, missing));
  }
  alignas(64) float padded[16];
  for (int i = 0; i < lanes; ++i) padded[i] = i < left ? bounds[i] : missing;
  return hn::Load(d, padded);
}

/// A bound that is NaN bounds nothing.
template <class D>
HWY_INLINE hn::VFromD<D> endlessIfNaN(D d, hn::VFromD<D> bounds, float endless) {
  return hn::IfThenElse(hn::IsNaN(bounds), hn::Set(d, endless), bounds);
}

/// Copies the boxes of an axis, gathers their union, and returns those that are not empty on it.
HWY_INLINE std::uint64_t copyAxis(BvhWalk& walk, const BoxLanes& boxes, int axis, int count) {
  const BoxTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  // If loads must not reach beyond the boxes, the last vector begins early and repeats boxes of the
  // one before it.
  const bool overlaps = HWY_MEM_OPS_MIGHT_FAULT && count >= lanes;
  if (overlaps) {
    const int last = (walk.vectorsOfBoxes - 1) * lanes;
    hn::Store(hn::Set(d, kFloatInfinity), d, walk.lower[axis] + last);
    hn::Store(hn::Set(d, -kFloatInfinity), d, walk.upper[axis] + last);
  }
  auto least = hn::Set(d, kFloatInfinity);
  auto most = hn::Set(d, -kFloatInfinity);
  std::uint64_t filled = 0;
  for (int vector = 0; vector < walk.vectorsOfBoxes; ++vector) {
    int first = vector * lanes;
    if (overlaps && first + lanes > count) first = count - lanes;
    const int at = walk.firstBox + first;
    const auto lower = endlessIfNaN(
        d, loadBounds(d, boxes.lower[axis] + at, count - first, kFloatInfinity), -kFloatInfinity);
    const auto upper = endlessIfNaN(
        d, loadBounds(d, boxes.upper[axis] + at, count - first, -kFloatInfinity), kFloatInfinity);
    hn::StoreU(lower, d, walk.lower[axis] + first);
    hn::StoreU(upper, d, walk.upper[axis] + first);
    filled |= bitsOf(d, hn::Le(lower, upper)) << first;
    least = hn::Min(least, lower);
    most = hn::Max(most, upper);
  }
  walk.unionLower[axis] = hn::GetLane(hn::MinOfLanes(d, least));
  walk.unionUpper[axis] = hn::GetLane(hn::MaxOfLanes(d, most));
  return filled;
}

void beginWalkInLanes(BvhWalk& walk, const BoxLanes& boxes, int first) {
  const int left = boxes.count - first;
  const int count = left < kBoxGroup ? left : kBoxGroup;
  const int lanes = static_cast<int>(hn::Lanes(BoxTag()));
  walk.firstBox = first;
  walk.vectorsOfBoxes = (count + lanes - 1) / lanes;
  walk.nodesVisited = walk.leavesVisited = 0;
  walk.nodesWaiting = walk.leavesWaiting = walk.leavesDone = walk.hitCount = 0;
  std::uint64_t alive = ~std::uint64_t{0};
  for (int axis = 0; axis < 3; ++axis) alive &= copyAxis(walk, boxes, axis, count);
  if (alive != 0) walk.waiting[walk.nodesWaiting++] = {alive, 0};
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {

HWY_EXPORT(beginWalkInLanes);
HWY_EXPORT(continueWalkInLanes);

}  // namespace

void beginWalk(BvhWalk& walk, const BoxLanes& boxes, int first) {
  HWY_DYNAMIC_DISPATCH(beginWalkInLanes)(walk, boxes, first);
}

void continueWalk(BvhWalk& walk) {
  HWY_DYNAMIC_DISPATCH(continueWalkInLanes)(walk);
}

}  // namespace foretouch::internal
#endif
