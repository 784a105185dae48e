// middleware/scene/nearest_walk.h: walks the flat tree down to its leaves, the nearest parts first.
// Not installed.
#pragma once

#include <cstdint>
#include <utility>

#include "lss/assert.h"
#include "middleware/scene/flat_bvh.h"

namespace foretouch::internal {

/// What waits: a child of a node, and how near it can be.
template <typename Child>
struct WaitingChild {
  double bound;
  Child child;
};

/// The nearest one last: it is taken first.
template <typename Child>
void sortNearestLast(WaitingChild<Child>* first, WaitingChild<Child>* last) {
  for (WaitingChild<Child>* next = first; next != last; ++next) {
    for (WaitingChild<Child>* at = next; at != first && (at - 1)->bound < at->bound; --at) {
      std::swap(at[-1], at[0]);
    }
  }
}

/// `visitor` has bounds(node, bounds), how near each child can be; limit(): what is beyond it is
/// left out; and leaf(leaf).
template <typename Visitor>
void walkNearestFirst(const FlatBvh& bvh, Visitor& visitor) {
  constexpr int kRoom = BvhWalk::kNodeRoom + kBvhWidth;
  WaitingChild<std::uint32_t> waiting[kRoom];
  int size = 0;
  waiting[size++] = {0.0, 0};
  while (size > 0) {
    const WaitingChild<std::uint32_t> next = waiting[--size];
    if (next.bound > visitor.limit()) continue;
    if ((next.child & BvhNode::kLeafFlag) != 0) {
      visitor.leaf(bvh.leaf(next.child & BvhNode::kLeafMask));
      continue;
    }
    const BvhNode& node = bvh.node(next.child);
    double bounds[kBvhWidth];
    visitor.bounds(node, bounds);
    const double limit = visitor.limit();
    const int first = size;
    FORETOUCH_ASSERT(first + kBvhWidth <= kRoom);
    for (int i = 0; i < kBvhWidth; ++i) {
      if (bounds[i] <= limit) waiting[size++] = {bounds[i], node.child[i]};
    }
    sortNearestLast(waiting + first, waiting + size);
  }
}

}  // namespace foretouch::internal
