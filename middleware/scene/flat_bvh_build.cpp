// FlatBvh::build(): a builder's tree, copied into flat arrays.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/bvh_tree.h"
#include "middleware/scene/flat_bvh.h"

namespace foretouch::internal {
using Eigen::Vector3d;

double vertexRoundingOf(const Aabb& scene, const Vector3d& origin) {
  constexpr double kRelative = 0x1.00001p-24;  // 2^-24 and 2^-53, and this sum's own roundings
  constexpr double kSubnormal = 0x1p-149;
  const Vector3d extent = (scene.max - origin).cwiseAbs().cwiseMax((scene.min - origin).cwiseAbs());
  return (extent.array() * kRelative + kSubnormal).matrix().norm() * 0x1.00001p0;
}

namespace {

/// Copies a tree into the flat arrays, children side by side and after their parents, without
/// recursion.
class FlatBvhBuilder {
 public:
  FlatBvhBuilder(const std::vector<Triangle>& triangles, const std::vector<TriangleId>& ids,
                 const Aabb& scene, const Vector3d& origin)
      : triangles_(triangles),
        ids_(ids),
        origin_(origin),
        vertexRounding_(vertexRoundingOf(scene, origin)) {}

  Result<Done> flatten(const TreeNode& root, const TreeBox& rootBox) {
    if (!isWhole(&root)) return Error::of(ErrorCode::DeviceFailed, "Embree built no whole root");
    const std::uint32_t rootIndex = addNode();
    if (root.numChildren == 0) {
      setChild(rootIndex, 0, rootBox, root, 1);
    } else {
      pending_.push_back({static_cast<const TreeInner*>(&root), rootIndex, 0});
    }
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      if (next.depth > kMaxBvhDepth) {
        return Error::of(ErrorCode::LimitExceeded,
                         "expected a tree of at most " + std::to_string(kMaxBvhDepth) + " levels");
      }
      for (unsigned i = 0; i < next.node->numChildren; ++i) {
        if (!isWhole(next.node->children[i])) {
          return Error::of(ErrorCode::DeviceFailed, "Embree built a part of the scene's tree");
        }
        setChild(next.index, i, next.node->boxes[i], *next.node->children[i], next.depth + 1);
      }
    }
    nodes_.shrink_to_fit();
    leaves_.shrink_to_fit();
    clusters_.shrink_to_fit();
    return Done{};
  }

  /// What was copied. The builder is empty then.
  FlatBvh take() {
    return {{FrozenArray<BvhNode>(std::move(nodes_)), FrozenArray<BvhLeaf>(std::move(leaves_)),
             FrozenArray<Cluster>(std::move(clusters_)), vertexRounding_},
            origin_};
  }

 private:
  struct Pending {
    const TreeInner* node;
    std::uint32_t index;
    int depth;
  };

  /// Without memory Embree may leave a part out, and say nothing.
  [[nodiscard]] bool isWhole(const TreeNode* node) const {
    if (node == nullptr || node->numChildren > kBvhWidth) return false;
    if (node->numChildren > 0) return true;
    const auto& leaf = static_cast<const TreeLeaf&>(*node);
    return leaf.size >= 1 && leaf.size <= kBvhWidth &&
           std::all_of(leaf.primitives, leaf.primitives + leaf.size,
                       [&](unsigned primitive) { return primitive < ids_.size(); });
  }

  std::uint32_t addNode() {
    BvhNode node{};
    for (int axis = 0; axis < 3; ++axis) {
      std::fill_n(node.lower[axis], kBvhWidth, kFloatInfinity);
      std::fill_n(node.upper[axis], kBvhWidth, -kFloatInfinity);
    }
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  void setChild(std::uint32_t index, unsigned slot, const TreeBox& box, const TreeNode& child,
                int depth) {
    const bool isLeaf = child.numChildren == 0;
    const std::uint32_t target = isLeaf ? addLeaf(static_cast<const TreeLeaf&>(child)) : addNode();
    BvhNode& node = nodes_[index];
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis][slot] = box.lower[axis];
      node.upper[axis][slot] = box.upper[axis];
    }
    node.child[slot] = target;
    if (!isLeaf) pending_.push_back({static_cast<const TreeInner*>(&child), target, depth});
  }

  /// Adds the leaf and its cluster; returns the child's word.
  std::uint32_t addLeaf(const TreeLeaf& built) {
    FORETOUCH_ASSERT(built.size >= 1 && built.size <= kBvhWidth);
    BvhLeaf leaf;
    for (unsigned i = 0; i < kBvhWidth; ++i) {
      const TriangleId id = ids_[built.primitives[std::min(i, built.size - 1)]];
      const Triangle& triangle = triangles_[slotOf(id)];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vector3d local = triangle.vertices[corner] - origin_;
        for (int axis = 0; axis < 3; ++axis) {
          leaf.vertex[corner][axis][i] = static_cast<float>(local[axis]);
        }
      }
      leaf.id[i] = i < built.size ? id : -1;
    }
    const auto index = static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back(leaf);
    clusters_.push_back(clusterOf(leaf));
    return BvhNode::kLeafFlag | ((built.size - 1) << BvhNode::kCountShift) | index;
  }

  /// The vertex of the leaf that is farthest from `centre`.
  static Vector3d farthest(const BvhLeaf& leaf, const Vector3d& centre) {
    Vector3d found = centre;
    double greatest = -1.0;
    for (const auto& corner : leaf.vertex) {
      for (int i = 0; i < kBvhWidth; ++i) {
        const Vector3d vertex(corner[0][i], corner[1][i], corner[2][i]);
        const double squared = (vertex - centre).squaredNorm();
        if (squared <= greatest) continue;
        greatest = squared;
        found = vertex;
      }
    }
    return found;
  }

  /// Approaches the least ball by steps of 1/(k+1) towards the farthest vertex, the core-set way of
  /// [BadoiuClarkson03]; any centre is right, because the radius comes last.
  [[nodiscard]] Cluster clusterOf(const BvhLeaf& leaf) const {
    constexpr int kSteps = 8;
    // Three differences, squares and a root in double: ten roundings at most.
    constexpr double kRounding = 1.0 + 16.0 * kUnitRoundoff;
    Aabb box;
    for (const auto& corner : leaf.vertex) {
      for (int i = 0; i < kBvhWidth; ++i) box.add({corner[0][i], corner[1][i], corner[2][i]});
    }
    Vector3d centre = 0.5 * (box.min + box.max);
    Cluster best{};
    best.radius = kFloatInfinity;
    for (int step = 0; step <= kSteps; ++step) {
      const Eigen::Vector3f rounded = centre.cast<float>();
      const Vector3d far = farthest(leaf, rounded.cast<double>());
      const double distance = (far - rounded.cast<double>()).norm();
      const float radius = floatAbove((distance + vertexRounding_) * kRounding);
      if (radius < best.radius) best = {{rounded.x(), rounded.y(), rounded.z()}, radius};
      centre += (far - centre) / (step + 2);
    }
    return best;
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<TriangleId>& ids_;
  const Vector3d origin_;
  const double vertexRounding_;
  std::vector<BvhNode> nodes_;
  std::vector<BvhLeaf> leaves_;
  std::vector<Cluster> clusters_;
  std::vector<Pending> pending_;
};

Result<std::unique_ptr<BvhTree>> buildTree(const std::vector<Triangle>& triangles,
                                           const std::vector<TriangleId>& ids,
                                           const Vector3d& origin) {
#if FORETOUCH_HAS_EMBREE
  if (activeTreeBuilder() == TreeBuilder::Embree) return buildEmbreeTree(triangles, ids, origin);
#endif
  return buildBinnedTree(triangles, ids, origin);
}

}  // namespace

Result<FlatBvh> FlatBvh::build(const std::vector<Triangle>& triangles,
                               const std::vector<TriangleId>& ids, const Aabb& scene,
                               const Vector3d& origin) {
  FORETOUCH_ASSERT(!ids.empty());
  FORETOUCH_TRY(const auto tree, buildTree(triangles, ids, origin));
  FlatBvhBuilder builder(triangles, ids, scene, origin);
  FORETOUCH_CHECK(builder.flatten(*tree->root, tree->box));
  return builder.take();
}

}  // namespace foretouch::internal
