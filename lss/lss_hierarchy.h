// lss/lss_hierarchy.h: a static binary tree of LSS over the triangles of one link. Metres, frame L.
// Source: [Redon04], [Kim07] for LSS hierarchies of an avatar's links; split and fit are ours. Not
// installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lss/index.h"
#include "lss/lss.h"

namespace foretouch {

/// A node of the tree or a triangle under it, in one number.
class HierarchyChild {
 public:
  static HierarchyChild node(std::int32_t index) { return HierarchyChild(index); }
  static HierarchyChild triangle(std::int32_t index) { return HierarchyChild(~index); }
  [[nodiscard]] bool isTriangle() const { return code_ < 0; }
  [[nodiscard]] std::int32_t index() const { return code_ < 0 ? ~code_ : code_; }
  [[nodiscard]] bool operator==(HierarchyChild other) const { return code_ == other.code_; }
  /// A total order: triangles after nodes, each by index.
  [[nodiscard]] bool operator<(HierarchyChild other) const {
    return isTriangle() != other.isTriangle() ? other.isTriangle() : index() < other.index();
  }

 private:
  explicit HierarchyChild(std::int32_t code) : code_(code) {}
  std::int32_t code_;
};

/// Every node's LSS contains all triangles below it, rounding included (a test owns this).
class LssHierarchy {
 public:
  struct Node {
    Lss lss;
    std::array<HierarchyChild, 2> children;
  };

  /// Over the `triangles` listed in `ids` (the tree's triangle indices are these ids), all finite;
  /// at least one. O(n log n): median splits, so the depth is at most 1 + log2(n).
  LssHierarchy(const std::vector<Triangle>& triangles, const std::vector<std::int32_t>& ids);

  [[nodiscard]] HierarchyChild root() const { return root_; }
  [[nodiscard]] const Node& node(std::int32_t index) const { return nodes_[slotOf(index)]; }
  [[nodiscard]] std::size_t numNodes() const { return nodes_.size(); }
  [[nodiscard]] std::size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  HierarchyChild split(const std::vector<Triangle>& triangles, std::int32_t* first,
                       std::int32_t* last);

  std::vector<Node> nodes_;
  HierarchyChild root_ = HierarchyChild::node(0);
};

}  // namespace foretouch
