#include "middleware/scene/scene_image.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "lss/vertex_order.h"
#include "middleware/scene/bvh_tree.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// For coordinates relative to the origin (m): all that float may round a scene's extent to.
constexpr float kMostLocal = 4e7F;

Error noScene(const std::string& why) {
  return Error::of(ErrorCode::Mismatch, "expected the parts of a scene: " + why);
}

/// False for NaN. In vectors, as all of a scene is read.
template <int Count, typename Number>
bool isWithin(const Number* numbers, Number most) {
  const Eigen::Map<const Eigen::Array<Number, Count, 1>> all(numbers);
  return all.abs().template maxCoeff<Eigen::PropagateNaN>() <= most;
}

/// How many are not finite.
Result<std::size_t> checkTriangles(const SceneParts& parts) {
  std::size_t left = 0;
  if (parts.triangles.size() > kMaxTriangles || parts.objectOf.size() != parts.triangles.size() ||
      parts.bvh.arrays().clusters.size() != parts.bvh.numLeaves()) {
    return noScene("their sizes differ");
  }
  const auto objects = static_cast<std::int64_t>(parts.objectNames.size());
  for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
    if (parts.objectOf[i] < 0 || parts.objectOf[i] >= objects) {
      return noScene("triangle " + std::to_string(i) + " belongs to no object");
    }
    // Those that are not finite are left out of the tree.
    if (isWithin<9>(parts.triangles[i].vertices[0].data(), kMaxCoordinate)) continue;
    if (isFinite(parts.triangles[i])) {
      return noScene("triangle " + std::to_string(i) + " is beyond 1e7 m");
    }
    ++left;
  }
  return left;
}

Result<Done> checkNumbers(const SceneParts& parts) {
  const FlatBvh::Arrays& tree = parts.bvh.arrays();
  const SceneAudit& audit = parts.audit;
  bool are = isWithin<3>(audit.boxMin.data(), kMaxCoordinate) &&
             isWithin<3>(audit.boxMax.data(), kMaxCoordinate) &&
             std::isfinite(audit.shortestEdge) && std::isfinite(audit.longestEdge) &&
             audit.triangles <= parts.triangles.size() && parts.origin.allFinite() &&
             parts.origin.cwiseAbs().maxCoeff() <= kMaxCoordinate && tree.vertexRounding >= 0.0 &&
             tree.vertexRounding <= kMostLocal;
  for (const BvhLeaf& leaf : tree.leaves) {
    are &= isWithin<9 * kBvhWidth>(&leaf.vertex[0][0][0], kMostLocal);
  }
  for (const Cluster& cluster : tree.clusters) {
    are &= isWithin<3>(cluster.centre, kMostLocal) && cluster.radius >= 0.0F &&
           cluster.radius <= kMostLocal;
  }
  return are ? Result<Done>(Done{}) : noScene("a number of its tree is out of range");
}

/// Follows the tree once, from parents to children, which come after them.
class TreeCheck {
 public:
  /// `notFinite`: so many triangles are none of the tree's.
  TreeCheck(const SceneParts& parts, std::size_t notFinite)
      : parts_(parts),
        notFinite_(notFinite),
        bvh_(parts.bvh),
        depth_(bvh_.numNodes(), -1),
        isLeafMet_(bvh_.numLeaves(), false),
        isMet_(parts.triangles.size(), false) {}

  Result<Done> run() {
    if (bvh_.numNodes() == 0) return noScene("its tree has no root");
    depth_[0] = 0;
    for (std::uint32_t index = 0; index < bvh_.numNodes(); ++index) {
      // None above it leads to it, or too many do.
      if (depth_[index] < 0 || depth_[index] > kMaxBvhDepth) return noWay();
      for (int slot = 0; slot < kBvhWidth; ++slot) {
        if (!isChildWhole(index, slot)) return noWay();
      }
    }
    if (std::find(isLeafMet_.begin(), isLeafMet_.end(), false) != isLeafMet_.end()) return noWay();
    if (met_ == isMet_.size() && notFinite_ == 0) return Done{};
    for (std::size_t i = 0; i < isMet_.size(); ++i) {
      if (isMet_[i] == isFinite(parts_.triangles[i])) continue;
      return noScene("its tree lacks triangle " + std::to_string(i));
    }
    return Done{};
  }

 private:
  static Error noWay() { return noScene("its tree has not one way to each leaf"); }

  bool isChildWhole(std::uint32_t index, int slot) {
    const BvhNode& node = bvh_.node(index);
    const std::uint32_t child = node.child[slot];
    if (child == 0) return isNothing(node, slot);
    for (int axis = 0; axis < 3; ++axis) {
      const float lower = node.lower[axis][slot], upper = node.upper[axis][slot];
      if (!(std::abs(lower) <= kMostLocal && std::abs(upper) <= kMostLocal)) return false;
    }
    if ((child & BvhNode::kLeafFlag) != 0) return isLeafWhole(child);
    if (child <= index || child >= bvh_.numNodes() || depth_[child] >= 0) return false;
    depth_[child] = depth_[index] + 1;
    return true;
  }

  /// The root is not a child of any node, so its number stands where there is none.
  static bool isNothing(const BvhNode& node, int slot) {
    for (int axis = 0; axis < 3; ++axis) {
      if (node.lower[axis][slot] != kFloatInfinity || node.upper[axis][slot] != -kFloatInfinity) {
        return false;
      }
    }
    return true;
  }

  bool isLeafWhole(std::uint32_t child) {
    const std::uint32_t index = child & BvhNode::kLeafMask;
    const auto count = static_cast<int>((child & ~BvhNode::kLeafFlag) >> BvhNode::kCountShift) + 1;
    if (index >= bvh_.numLeaves() || isLeafMet_[index]) return false;
    isLeafMet_[index] = true;
    const BvhLeaf& leaf = bvh_.leaf(index);
    for (int i = 0; i < kBvhWidth; ++i) {
      const TriangleId id = leaf.id[i];
      if (i >= count) {
        if (id != -1) return false;
        continue;
      }
      if (id < 0 || slotOf(id) >= isMet_.size() || isMet_[slotOf(id)]) return false;
      isMet_[slotOf(id)] = true;
      ++met_;
    }
    return true;
  }

  const SceneParts& parts_;
  const std::size_t notFinite_;
  const FlatBvh& bvh_;
  std::vector<int> depth_;  // per node; below zero: no way led to it yet
  std::vector<bool> isLeafMet_, isMet_;
  std::size_t met_ = 0;
};

/// Whether it is inside, and not empty.
bool isInside(const Aabb& inner, const BvhNode& node, int slot) {
  if (!(inner.min.array() <= inner.max.array()).all()) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(node.lower[axis][slot] <= inner.min[axis] && inner.max[axis] <= node.upper[axis][slot])) {
      return false;
    }
  }
  return true;
}

/// The box around the true triangles of a leaf, relative to the origin; empty if the leaf or its
/// ball does not have them.
Aabb boxOfLeaf(const SceneParts& parts, std::uint32_t index) {
  const BvhLeaf& leaf = parts.bvh.leaf(index);
  const Cluster& ball = parts.bvh.cluster(index);
  const Vector3d centre(ball.centre[0], ball.centre[1], ball.centre[2]);
  Aabb box;
  for (int i = 0; i < leaf.count(); ++i) {
    const Triangle& triangle = parts.triangles[slotOf(leaf.id[i])];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3d local = triangle.vertices[corner] - parts.origin;
      for (int axis = 0; axis < 3; ++axis) {
        if (leaf.vertex[corner][axis][i] != static_cast<float>(local[axis])) return {};
      }
      if ((local - centre).norm() > ball.radius) return {};
      box.add(local);
    }
  }
  return box;
}

/// The box of all finite triangles, each of which has its vertices in order.
Result<Aabb> boxOfOrdered(const SceneParts& parts) {
  Aabb whole;
  for (const TriangleId id : parts.finiteIds()) {
    const Triangle& triangle = parts.triangles[slotOf(id)];
    whole.add(boxOf(triangle));
    if (!std::is_sorted(triangle.vertices.begin(), triangle.vertices.end(),
                        isBeforeByCoordinates<Vector3d>)) {
      return noScene("triangle " + std::to_string(id) + " has its vertices out of order");
    }
  }
  return whole;
}

/// Children come after their parents, so from the last node on each box is known when it is asked.
bool doBoxesHold(const SceneParts& parts) {
  const FlatBvh& bvh = parts.bvh;
  std::vector<Aabb> boxes(bvh.numNodes());
  for (std::uint32_t index = bvh.numNodes(); index-- > 0;) {
    const BvhNode& node = bvh.node(index);
    for (int slot = 0; slot < kBvhWidth; ++slot) {
      const std::uint32_t child = node.child[slot];
      if (child == 0) continue;
      const bool isLeaf = (child & BvhNode::kLeafFlag) != 0;
      const Aabb inner = isLeaf ? boxOfLeaf(parts, child & BvhNode::kLeafMask) : boxes[child];
      if (!isInside(inner, node, slot)) return false;
      boxes[index].add(inner);
    }
  }
  return true;
}

}  // namespace

Result<Scene> sceneOf(std::shared_ptr<SceneParts> parts) {
  FORETOUCH_TRY(const std::size_t notFinite, checkTriangles(*parts));
  FORETOUCH_CHECK(checkNumbers(*parts));
  FORETOUCH_CHECK(TreeCheck(*parts, notFinite).run());
  return Scene(std::move(parts));
}

Result<Done> holdsItsTriangles(const Scene& scene) {
  const SceneParts& parts = scene.parts();
  FORETOUCH_TRY(const Aabb whole, boxOfOrdered(parts));
  if (parts.bvh.vertexRounding() < vertexRoundingOf(whole, parts.origin)) {
    return noScene("its tree rounds by more than it says");
  }
  if (!doBoxesHold(parts)) return noScene("a box of its tree does not hold its triangles");
  return Done{};
}

}  // namespace foretouch::internal
