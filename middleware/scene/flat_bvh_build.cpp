// FlatBvh::build(): Embree's tree, and its copy into flat arrays.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include <embree3/rtcore.h>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/embree_device.h"
#include "middleware/scene/flat_bvh.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

// Eight triangles in lanes cost as much as one, so we do not split a leaf: with 6.5 triangles per
// leaf instead of 2.8, a pose in 300k triangles costs half and the tree takes half the memory.
constexpr unsigned kSahBlockSize = kBvhWidth;
constexpr unsigned kMinLeafSize = kBvhWidth;

/// The tree that Embree's callbacks make, in Embree's memory; freed with the RTCBVH.
struct BuildNode {
  unsigned numChildren;  // 0: a BuildLeaf
};

struct BuildInner : BuildNode {
  const BuildNode* children[kBvhWidth];
  RTCBounds bounds[kBvhWidth];
};

struct BuildLeaf : BuildNode {
  unsigned size;
  unsigned primitives[kBvhWidth];
};

constexpr std::size_t kEmbreeAlignment = 16;

/// Null without memory, which `hasShortage` (an atomic bool) then tells: Embree goes on without the
/// node, and so do the callbacks.
template <typename Node>
Node* newNode(RTCThreadLocalAllocator allocator, void* hasShortage) {
  void* const place = rtcThreadLocalAlloc(allocator, sizeof(Node), kEmbreeAlignment);
  if (place != nullptr) return new (place) Node{};
  *static_cast<std::atomic<bool>*>(hasShortage) = true;
  return nullptr;
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned numChildren, void* hasShortage) {
  auto* node = newNode<BuildInner>(allocator, hasShortage);
  if (node == nullptr) return nullptr;
  node->numChildren = numChildren;
  return static_cast<BuildNode*>(node);
}

void setChildren(void* node, void** children, unsigned count, void*) {
  if (node == nullptr) return;
  auto* inner = static_cast<BuildInner*>(static_cast<BuildNode*>(node));
  for (unsigned i = 0; i < count; ++i) {
    inner->children[i] = static_cast<const BuildNode*>(children[i]);
  }
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  if (node == nullptr) return;
  auto* inner = static_cast<BuildInner*>(static_cast<BuildNode*>(node));
  for (unsigned i = 0; i < count; ++i) inner->bounds[i] = *bounds[i];
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                 size_t count, void* hasShortage) {
  auto* leaf = newNode<BuildLeaf>(allocator, hasShortage);
  if (leaf == nullptr) return nullptr;
  leaf->numChildren = 0;
  leaf->size = static_cast<unsigned>(count);
  for (size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
  return static_cast<BuildNode*>(leaf);
}

struct ReleaseBvh {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

/// Boxes around the triangles, relative to the origin, rounded outward.
std::vector<RTCBuildPrimitive> primitivesOf(const std::vector<Triangle>& triangles,
                                            const std::vector<TriangleId>& ids,
                                            const Vector3d& origin) {
  std::vector<RTCBuildPrimitive> primitives(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Aabb box = boxOf(triangles[slotOf(ids[i])]);
    const Vector3d lower = box.min - origin;
    const Vector3d upper = box.max - origin;
    primitives[i] = {floatBelow(lower.x()), floatBelow(lower.y()),
                     floatBelow(lower.z()), 0,
                     floatAbove(upper.x()), floatAbove(upper.y()),
                     floatAbove(upper.z()), static_cast<unsigned>(i)};
  }
  return primitives;
}

RTCBuildArguments argumentsOf(RTCBVH tree, std::vector<RTCBuildPrimitive>& primitives,
                              std::atomic<bool>& hasShortage) {
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = kBvhWidth;
  arguments.maxDepth = kMaxBvhDepth;
  arguments.sahBlockSize = kSahBlockSize;
  arguments.minLeafSize = kMinLeafSize;
  arguments.maxLeafSize = kBvhWidth;
  arguments.bvh = tree;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = createNode;
  arguments.setNodeChildren = setChildren;
  arguments.setNodeBounds = setBounds;
  arguments.createLeaf = createLeaf;
  arguments.userPtr = &hasShortage;
  return arguments;
}

/// A root that is a leaf has no bounds of its own: returns those of all triangles.
RTCBounds boundsOf(const std::vector<RTCBuildPrimitive>& primitives) {
  RTCBounds all{kFloatInfinity,  kFloatInfinity,  kFloatInfinity,  0,
                -kFloatInfinity, -kFloatInfinity, -kFloatInfinity, 0};
  for (const RTCBuildPrimitive& p : primitives) {
    all = {std::min(all.lower_x, p.lower_x), std::min(all.lower_y, p.lower_y),
           std::min(all.lower_z, p.lower_z), 0,
           std::max(all.upper_x, p.upper_x), std::max(all.upper_y, p.upper_y),
           std::max(all.upper_z, p.upper_z), 0};
  }
  return all;
}

/// flat_bvh.md, "Vertices". `scene` is the box of all vertices.
double vertexRoundingOf(const Aabb& scene, const Vector3d& origin) {
  constexpr double kRelative = 0x1.00001p-24;  // 2^-24 and 2^-53, and this sum's own roundings
  constexpr double kSubnormal = 0x1p-149;
  const Vector3d extent = (scene.max - origin).cwiseAbs().cwiseMax((scene.min - origin).cwiseAbs());
  return (extent.array() * kRelative + kSubnormal).matrix().norm() * 0x1.00001p0;
}

}  // namespace

/// Copies Embree's tree into the flat arrays, children side by side, without recursion.
class FlatBvhBuilder {
 public:
  FlatBvhBuilder(FlatBvh& bvh, const std::vector<Triangle>& triangles,
                 const std::vector<TriangleId>& ids)
      : bvh_(bvh), triangles_(triangles), ids_(ids) {}

  void setOrigin(const Vector3d& origin) {
    Aabb scene;
    for (const TriangleId id : ids_) scene.add(boxOf(triangles_[slotOf(id)]));
    bvh_.origin_ = origin;
    bvh_.vertexRounding_ = vertexRoundingOf(scene, origin);
  }

  Result<Done> flatten(const BuildNode& root, const RTCBounds& rootBounds) {
    if (!isWhole(&root)) return Error::of(ErrorCode::DeviceFailed, "Embree built no whole root");
    const std::uint32_t rootIndex = addNode();
    if (root.numChildren == 0) {
      setChild(rootIndex, 0, rootBounds, root, 1);
    } else {
      pending_.push_back({static_cast<const BuildInner*>(&root), rootIndex, 0});
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
        setChild(next.index, i, next.node->bounds[i], *next.node->children[i], next.depth + 1);
      }
    }
    bvh_.nodes_.shrink_to_fit();
    bvh_.leaves_.shrink_to_fit();
    bvh_.clusters_.shrink_to_fit();
    return Done{};
  }

 private:
  struct Pending {
    const BuildInner* node;
    std::uint32_t index;
    int depth;
  };

  /// Without memory Embree may leave a part out, and say nothing.
  [[nodiscard]] bool isWhole(const BuildNode* node) const {
    if (node == nullptr || node->numChildren > kBvhWidth) return false;
    if (node->numChildren > 0) return true;
    const auto& leaf = static_cast<const BuildLeaf&>(*node);
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
    bvh_.nodes_.push_back(node);
    return static_cast<std::uint32_t>(bvh_.nodes_.size() - 1);
  }

  void setChild(std::uint32_t index, unsigned slot, const RTCBounds& bounds, const BuildNode& child,
                int depth) {
    const bool isLeaf = child.numChildren == 0;
    const std::uint32_t target = isLeaf ? addLeaf(static_cast<const BuildLeaf&>(child)) : addNode();
    BvhNode& node = bvh_.nodes_[index];
    const float lower[3] = {bounds.lower_x, bounds.lower_y, bounds.lower_z};
    const float upper[3] = {bounds.upper_x, bounds.upper_y, bounds.upper_z};
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis][slot] = lower[axis];
      node.upper[axis][slot] = upper[axis];
    }
    node.child[slot] = target;
    if (!isLeaf) pending_.push_back({static_cast<const BuildInner*>(&child), target, depth});
  }

  /// Adds the leaf and its cluster; returns the child's word.
  std::uint32_t addLeaf(const BuildLeaf& built) {
    FORETOUCH_ASSERT(built.size >= 1 && built.size <= kBvhWidth);
    BvhLeaf leaf;
    for (unsigned i = 0; i < kBvhWidth; ++i) {
      const TriangleId id = ids_[built.primitives[std::min(i, built.size - 1)]];
      const Triangle& triangle = triangles_[slotOf(id)];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vector3d local = triangle.vertices[corner] - bvh_.origin_;
        for (int axis = 0; axis < 3; ++axis) {
          leaf.vertex[corner][axis][i] = static_cast<float>(local[axis]);
        }
      }
      leaf.id[i] = i < built.size ? id : -1;
    }
    const auto index = static_cast<std::uint32_t>(bvh_.leaves_.size());
    bvh_.leaves_.push_back(leaf);
    bvh_.clusters_.push_back(clusterOf(leaf));
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
      const float radius = floatAbove((distance + bvh_.vertexRounding_) * kRounding);
      if (radius < best.radius) best = {{rounded.x(), rounded.y(), rounded.z()}, radius};
      centre += (far - centre) / (step + 2);
    }
    return best;
  }

  FlatBvh& bvh_;
  const std::vector<Triangle>& triangles_;
  const std::vector<TriangleId>& ids_;
  std::vector<Pending> pending_;
};

Result<FlatBvh> FlatBvh::build(const std::vector<Triangle>& triangles,
                               const std::vector<TriangleId>& ids, const Vector3d& origin) {
  FORETOUCH_ASSERT(!ids.empty());
  FORETOUCH_TRY(auto device, newEmbreeDevice());
  const std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh> tree(rtcNewBVH(device.get()));
  FORETOUCH_CHECK(embreeStatus(device.get(), "making room for the scene's tree"));
  if (tree == nullptr) return Error::of(ErrorCode::DeviceFailed, "Embree made no tree");
  std::vector<RTCBuildPrimitive> primitives = primitivesOf(triangles, ids, origin);
  std::atomic<bool> hasShortage{false};
  const RTCBuildArguments arguments = argumentsOf(tree.get(), primitives, hasShortage);
  const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
  FORETOUCH_CHECK(embreeStatus(device.get(), "building the scene's tree"));
  if (hasShortage) {
    return Error::of(ErrorCode::DeviceFailed, "Embree had no memory for the scene's tree");
  }
  if (root == nullptr) return Error::of(ErrorCode::DeviceFailed, "Embree built no tree");
  const RTCBounds rootBounds = boundsOf(primitives);
  primitives = {};  // makes room for the flat arrays
  FlatBvh bvh;
  FlatBvhBuilder builder(bvh, triangles, ids);
  builder.setOrigin(origin);
  FORETOUCH_CHECK(builder.flatten(*root, rootBounds));
  return Result<FlatBvh>(std::move(bvh));
}

}  // namespace foretouch::internal
