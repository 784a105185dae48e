#include "middleware/surface/wide_nodes.h"

#include <algorithm>
#include <utility>

#include "lss/assert.h"

namespace foretouch::internal {
namespace {

constexpr auto kMostBelow = static_cast<std::int32_t>(kTrianglePairLanes);

/// The largest power of sixteen below the count: what is below holds no more each, so that only the
/// topmost node has fewer below than lanes hold.
std::int32_t mostOfEach(std::int32_t count) {
  std::int32_t most = 1;
  while (kMostBelow * static_cast<std::int64_t>(most) < count) most *= kMostBelow;
  return most;
}

template <std::size_t... kIndices>
WideNode emptyAt(HierarchyChild node, std::index_sequence<kIndices...>) {
  return {{((void)kIndices, node)...}, {}};
}

void put(const LanePart& part, std::size_t lane, PartRows& rows) {
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) rows.point[i][axis][lane] = part.point[i][axis];
  }
  rows.rho[lane] = part.rho;
  rows.radius[lane] = part.radius;
}

}  // namespace

WideNodes::WideNodes(const LssHierarchy& hierarchy, const std::vector<LanePart>& triangles) {
  const HierarchyChild root = hierarchy.root();
  if (root.isTriangle()) return;
  const auto numNodes = static_cast<std::int32_t>(hierarchy.numNodes());
  places_.assign(hierarchy.numNodes(), -1);
  // What is below a node comes after it.
  std::vector<std::int32_t> counts(hierarchy.numNodes());
  const auto countIn = [&counts](HierarchyChild part) {
    return part.isTriangle() ? 1 : counts[slotOf(part.index())];
  };
  for (std::int32_t node = numNodes - 1; node >= 0; --node) {
    const auto& children = hierarchy.node(node).children;
    counts[slotOf(node)] = countIn(children[0]) + countIn(children[1]);
  }
  std::vector<HierarchyChild> open{root}, parts;
  while (!open.empty()) {
    const HierarchyChild node = open.back();
    open.pop_back();
    const std::int32_t most = mostOfEach(countIn(node));
    // The halves of halves are as large as each other, so that there are no more than lanes.
    parts = {node};
    WideNode wide = emptyAt(node, std::make_index_sequence<kTrianglePairLanes>());
    while (!parts.empty()) {
      const HierarchyChild part = parts.back();
      parts.pop_back();
      if (countIn(part) > most) {
        for (const HierarchyChild child : hierarchy.node(part.index()).children) {
          parts.push_back(child);
        }
        continue;
      }
      FORETOUCH_ASSERT(wide.parts.count < kMostBelow);
      const auto lane = static_cast<std::size_t>(wide.parts.count++);
      wide.below[lane] = part;
      put(part.isTriangle() ? triangles[slotOf(part.index())]
                            : lanePart(hierarchy.node(part.index()).lss),
          lane, wide.parts);
      wide.parts.areAxes = wide.parts.areAxes && !part.isTriangle();
      if (!part.isTriangle()) open.push_back(part);
    }
    places_[slotOf(node.index())] = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(wide);
  }
}

}  // namespace foretouch::internal
