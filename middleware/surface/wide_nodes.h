// middleware/surface/wide_nodes.h: the hierarchy over a link's triangles with up to sixteen parts
// below each node, side by side as lanes read them: from the whole mesh to its triangles in as few
// looks as can be, none of which gathers anything. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lss/index.h"
#include "lss/lss_hierarchy.h"
#include "middleware/lanes/axis_parts.h"
#include "middleware/lanes/frame_lanes.h"

namespace foretouch::internal {

/// What is below a node, and the same in lanes.
struct WideNode {
  std::array<HierarchyChild, kTrianglePairLanes> below;
  PartRows parts;
};

class WideNodes {
 public:
  /// `triangles`: all of the link's, by index.
  WideNodes(const LssHierarchy& hierarchy, const std::vector<LanePart>& triangles);

  /// What is below the hierarchy's root, or below a node that is below another one here.
  [[nodiscard]] const WideNode& at(HierarchyChild node) const {
    return nodes_[slotOf(places_[slotOf(node.index())])];
  }

 private:
  std::vector<std::int32_t> places_;  // in nodes_, per node of the hierarchy; -1: none
  std::vector<WideNode> nodes_;
};

}  // namespace foretouch::internal
