// buildEmbreeTree(): rtcBuildBVH, whose callbacks make our nodes in Embree's memory.
#include <atomic>
#include <new>
#include <utility>

#include <embree3/rtcore.h>

#include "articulated/try.h"
#include "lss/assert.h"
#include "middleware/scene/bvh_tree.h"
#include "middleware/scene/embree_device.h"

namespace foretouch::internal {
namespace {

// Eight triangles in lanes cost as much as one, so we do not split a leaf: with 6.5 triangles per
// leaf instead of 2.8, a pose in 300k triangles costs half and the tree takes half the memory.
constexpr unsigned kSahBlockSize = kBvhWidth;
constexpr unsigned kMinLeafSize = kBvhWidth;

constexpr std::size_t kEmbreeAlignment = 16;

/// Null without memory, which `hasShortage` (an atomic bool) then says: Embree goes on without the
/// node, and so do the callbacks.
template <typename Node>
Node* newNode(RTCThreadLocalAllocator allocator, void* hasShortage) {
  void* const place = rtcThreadLocalAlloc(allocator, sizeof(Node), kEmbreeAlignment);
  if (place != nullptr) return new (place) Node{};
  *static_cast<std::atomic<bool>*>(hasShortage) = true;
  return nullptr;
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned numChildren, void* hasShortage) {
  auto* node = newNode<TreeInner>(allocator, hasShortage);
  if (node == nullptr) return nullptr;
  node->numChildren = numChildren;
  return static_cast<TreeNode*>(node);
}

void setChildren(void* node, void** children, unsigned count, void*) {
  if (node == nullptr) return;
  auto* inner = static_cast<TreeInner*>(static_cast<TreeNode*>(node));
  for (unsigned i = 0; i < count; ++i) {
    inner->children[i] = static_cast<const TreeNode*>(children[i]);
  }
}

TreeBox boxOf(const RTCBounds& bounds) {
  return {{bounds.lower_x, bounds.lower_y, bounds.lower_z},
          {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  if (node == nullptr) return;
  auto* inner = static_cast<TreeInner*>(static_cast<TreeNode*>(node));
  for (unsigned i = 0; i < count; ++i) inner->boxes[i] = boxOf(*bounds[i]);
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                 size_t count, void* hasShortage) {
  auto* leaf = newNode<TreeLeaf>(allocator, hasShortage);
  if (leaf == nullptr) return nullptr;
  leaf->numChildren = 0;
  leaf->size = static_cast<unsigned>(count);
  for (size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
  return static_cast<TreeNode*>(leaf);
}

struct ReleaseBvh {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

class EmbreeTree final : public BvhTree {
 public:
  explicit EmbreeTree(EmbreeDevice device)
      : device_(std::move(device)), nodes_(rtcNewBVH(device_.get())) {}
  [[nodiscard]] RTCBVH nodes() const { return nodes_.get(); }

 private:
  EmbreeDevice device_;
  std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh> nodes_;
};

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

TreeBox boxOf(const std::vector<RTCBuildPrimitive>& primitives) {
  TreeBox all;
  for (const RTCBuildPrimitive& p : primitives) {
    all.add({{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}});
  }
  return all;
}

}  // namespace

Result<std::unique_ptr<BvhTree>> buildEmbreeTree(const std::vector<Triangle>& triangles,
                                                 const std::vector<TriangleId>& ids,
                                                 const Eigen::Vector3d& origin) {
  FORETOUCH_ASSERT(!ids.empty());
  FORETOUCH_TRY(auto device, newEmbreeDevice());
  const RTCDevice handle = device.get();
  auto tree = std::make_unique<EmbreeTree>(std::move(device));
  const RTCBVH nodes = tree->nodes();
  FORETOUCH_CHECK(embreeStatus(handle, "making room for the scene's tree"));
  if (nodes == nullptr) return Error::of(ErrorCode::DeviceFailed, "Embree made no tree");
  auto primitives = primitivesOf<RTCBuildPrimitive>(triangles, ids, origin);
  std::atomic<bool> hasShortage{false};
  const RTCBuildArguments arguments = argumentsOf(nodes, primitives, hasShortage);
  tree->root = static_cast<const TreeNode*>(rtcBuildBVH(&arguments));
  FORETOUCH_CHECK(embreeStatus(handle, "building the scene's tree"));
  if (hasShortage) {
    return Error::of(ErrorCode::DeviceFailed, "Embree had no memory for the scene's tree");
  }
  if (tree->root == nullptr) return Error::of(ErrorCode::DeviceFailed, "Embree built no tree");
  tree->box = boxOf(primitives);
  return std::unique_ptr<BvhTree>(std::move(tree));
}

}  // namespace foretouch::internal
