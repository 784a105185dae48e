// middleware/scene/bvh_tree.h: a tree over boxes as a builder leaves it, before FlatBvh copies it
// into its arrays, and the two builders. Lengths in metres, floats, relative to the tree's origin.
// Not installed.
#pragma once

#include <cstdint>
#include <hwy/cache_control.h>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/flat_bvh_lanes.h"

namespace foretouch::internal {

/// What decides which triangles lie together. The hits of a walk do not depend on it (flat_bvh.md),
/// its cost and the order of the hits do.
enum class TreeBuilder : std::uint8_t {
  Embree,  ///< rtcBuildBVH, on all cores. Where this library was built with Embree.
  Binned,  ///< Our own: the same tree, bit for bit, on every machine. On one core.
};

/// "embree", "binned".
[[nodiscard]] const char* toString(TreeBuilder builder);
/// Those of this library; the first is the one that scenes are built with.
[[nodiscard]] const std::vector<TreeBuilder>& treeBuilders();
[[nodiscard]] TreeBuilder activeTreeBuilder();
/// From now on the whole process builds with `builder`, or with the first if empty; false, without
/// a change, if this library lacks it. For tests and measurements: not while a scene is built.
bool useTreeBuilder(std::optional<TreeBuilder> builder);

struct TreeBox {
  float lower[3] = {kFloatInfinity, kFloatInfinity, kFloatInfinity};
  float upper[3] = {-kFloatInfinity, -kFloatInfinity, -kFloatInfinity};

  void add(const TreeBox& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = other.lower[axis] < lower[axis] ? other.lower[axis] : lower[axis];
      upper[axis] = other.upper[axis] > upper[axis] ? other.upper[axis] : upper[axis];
    }
  }
};

struct TreeNode {
  unsigned numChildren;  ///< 0: a TreeLeaf.
};
struct TreeInner : TreeNode {
  const TreeNode* children[kBvhWidth];
  TreeBox boxes[kBvhWidth];
};
struct TreeLeaf : TreeNode {
  unsigned size;
  unsigned primitives[kBvhWidth];  ///< Places in the ids that the tree was built of.
};

/// Owns its nodes. Where memory ended, a builder may have left out a part: its readers check.
class BvhTree {
 public:
  virtual ~BvhTree() = default;

  const TreeNode* root = nullptr;
  TreeBox box;  ///< Around all primitives.
};

/// A tree of at least one triangle `triangles[id]`, by Embree. Errors: DeviceFailed.
[[nodiscard]] Result<std::unique_ptr<BvhTree>> buildEmbreeTree(
    const std::vector<Triangle>& triangles, const std::vector<TriangleId>& ids,
    const Eigen::Vector3d& origin);

/// By binned surface-area costs [Wald07]. Depends on the boxes in their order, and on nothing else.
/// No inner node lies deeper than `deepest`, which leaves room for all triangles:
/// 8^(deepest + 2) or fewer. O(n log n).
[[nodiscard]] std::unique_ptr<BvhTree> buildBinnedTree(const std::vector<Triangle>& triangles,
                                                       const std::vector<TriangleId>& ids,
                                                       const Eigen::Vector3d& origin,
                                                       int deepest = kMaxBvhDepth);

/// FlatBvh::vertexRounding() (flat_bvh.md, "Vertices"). `scene` is the box of all vertices.
[[nodiscard]] double vertexRoundingOf(const Aabb& scene, const Eigen::Vector3d& origin);

/// Boxes around the triangles, relative to the origin, rounded outward, in the builder's layout:
/// lower x, y, z, a zero, upper x, y, z, and the place in `ids`.
template <typename Primitive>
std::vector<Primitive> primitivesOf(const std::vector<Triangle>& triangles,
                                    const std::vector<TriangleId>& ids,
                                    const Eigen::Vector3d& origin) {
  std::vector<Primitive> primitives(ids.size());
  // The ids' order is one of chance: each triangle is a cache miss, which is asked for early.
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i + kAhead < ids.size()) {
      const Triangle& next = triangles[slotOf(ids[i + kAhead])];
      hwy::Prefetch(&next);
      hwy::Prefetch(&next.vertices[2]);
    }
    const Aabb box = boxOf(triangles[slotOf(ids[i])]);
    const Eigen::Vector3d lower = box.min - origin;
    const Eigen::Vector3d upper = box.max - origin;
    primitives[i] = {floatBelow(lower.x()), floatBelow(lower.y()),
                     floatBelow(lower.z()), 0,
                     floatAbove(upper.x()), floatAbove(upper.y()),
                     floatAbove(upper.z()), static_cast<unsigned>(i)};
  }
  return primitives;
}

}  // namespace foretouch::internal
