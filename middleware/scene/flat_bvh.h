// middleware/scene/flat_bvh.h: the culler: a builder makes the tree (bvh_tree.h), we flatten it
// into 8-wide nodes of floats rounded outward and leaves of eight triangles, and walk it ourselves,
// one box at a time or all boxes of a pose at once. Proofs: flat_bvh.md. Not installed.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "middleware/scene/frozen_array.h"

namespace foretouch::internal {

/// Boxes and vertices in float, relative to an origin that is subtracted in double. Subtraction and
/// rounding are monotone, so boxes that overlap in the world overlap here, without slack. About 65
/// bytes per triangle. The same tree for any number of threads.
class FlatBvh final : public TriangleCuller {
 public:
  using Leaf = BvhLeaf;

  /// A tree of `triangles[id]` for every id of `ids`, which are finite; at least one. `scene` holds
  /// all of these.
  static Result<FlatBvh> build(const std::vector<Triangle>& triangles,
                               const std::vector<TriangleId>& ids, const Aabb& scene,
                               const Eigen::Vector3d& origin);

  /// What it consists of. The root is the first node; one cluster per leaf.
  struct Arrays {
    FrozenArray<BvhNode> nodes;
    FrozenArray<BvhLeaf> leaves;
    FrozenArray<Cluster> clusters;
    double vertexRounding = 0.0;
  };
  FlatBvh() = default;
  FlatBvh(Arrays arrays, const Eigen::Vector3d& origin)
      : origin_(origin), arrays_(std::move(arrays)) {}
  [[nodiscard]] const Arrays& arrays() const { return arrays_; }

  void collect(const Aabb& box, std::vector<TriangleId>& ids,
               std::uint64_t& visited) const override;

  /// Does any leaf's box, as its parent stores it, meet `box`? If not, no triangle's box does.
  [[nodiscard]] bool meetsLeaf(const Aabb& box, std::uint64_t& visited) const;

  /// Appends every (leaf, box) for which the leaf's box, as its parent stores it, meets the box
  /// that was rounded outward: all leaves with a triangle whose true box meets it, each once per
  /// box. Reads no leaf, so memory beyond the caches is read only when needed. The hits of a box
  /// come in ascending order of leaves; the order depends only on the tree and the boxes. Adds to
  /// the counters: a node or a leaf counts once per kBoxGroup boxes.
  void collectLeaves(const BoxLanes& boxes, std::vector<LeafHit>& hits, std::uint64_t& nodesVisited,
                     std::uint64_t& leavesVisited) const override;

  [[nodiscard]] std::uint32_t numLeaves() const {
    return static_cast<std::uint32_t>(arrays_.leaves.size());
  }
  [[nodiscard]] std::uint32_t numNodes() const {
    return static_cast<std::uint32_t>(arrays_.nodes.size());
  }
  /// The root is 0.
  [[nodiscard]] const BvhNode& node(std::uint32_t index) const { return arrays_.nodes[index]; }
  [[nodiscard]] const BvhLeaf& leaf(std::uint32_t index) const { return arrays_.leaves[index]; }
  [[nodiscard]] const BvhLeaf* leaves() const { return arrays_.leaves.data(); }
  [[nodiscard]] const Cluster& cluster(std::uint32_t index) const {
    return arrays_.clusters[index];
  }
  /// All of them, one per leaf.
  [[nodiscard]] const Cluster* clusters() const { return arrays_.clusters.data(); }
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  /// Bound (m) on the distance of a leaf's vertex, taken back to the world without rounding, from
  /// the triangle's. Depends on the box of the whole scene only.
  [[nodiscard]] double vertexRounding() const { return arrays_.vertexRounding; }

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Arrays arrays_;
};

}  // namespace foretouch::internal
