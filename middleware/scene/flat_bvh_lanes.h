// middleware/scene/flat_bvh_lanes.h: the flat tree's nodes and leaves, and the walk of many boxes
// through it in the processor's lanes. Plain arrays only: the build compiles the walk once per
// vector width. Lengths in metres, in the frame of the world moved to the tree's origin. Not
// installed.
#pragma once

#include <cstdint>
#include <limits>

#include "middleware/scene/raw_scene.h"

namespace foretouch::internal {

/// Children of a node, and triangles of a leaf.
inline constexpr int kBvhWidth = 8;
/// Boxes per walk: one bit each.
inline constexpr int kBoxGroup = 64;
/// Levels below the root; the builder makes no deeper tree.
inline constexpr int kMaxBvhDepth = 48;
inline constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

/// Structure of arrays: lower[axis][child]. An unused child has an inverted box, which meets none.
struct alignas(64) BvhNode {
  float lower[3][kBvhWidth], upper[3][kBvhWidth];
  /// Node index, or kLeafFlag, the number of triangles less one, and the leaf's index.
  std::uint32_t child[kBvhWidth];

  static constexpr std::uint32_t kLeafFlag = 0x80000000u;
  static constexpr int kCountShift = 28;
  static constexpr std::uint32_t kLeafMask = (1u << kCountShift) - 1;
};
static_assert(sizeof(BvhNode) == 256);

/// Up to eight triangles, their vertices rounded to nearest. Unused places repeat the last triangle
/// with the id -1.
struct alignas(64) BvhLeaf {
  float vertex[3][3][kBvhWidth];  ///< [corner][axis][triangle]
  TriangleId id[kBvhWidth];

  [[nodiscard]] int count() const {
    int used = kBvhWidth;
    while (id[used - 1] < 0) --used;
    return used;
  }
};
static_assert(sizeof(BvhLeaf) == 320, "five cache lines");

/// A ball that contains a leaf's true triangles: rounding is in its radius.
struct alignas(16) Cluster {
  float centre[3], radius;
};

/// Boxes to walk with, relative to the tree's origin, rounded outward by the caller. Closed. A box
/// with lower > upper on an axis is empty and meets nothing; a bound that is NaN bounds nothing.
struct BoxLanes {
  int count = 0;  ///< At most kMaxBoxes.
  const float* lower[3] = {};
  const float* upper[3] = {};

  static constexpr int kMaxBoxes = 1 << 16;
};

/// Bit i of `triangles`: the leaf has an i-th triangle, which box `box` may meet. Never 0.
struct LeafHit {
  std::uint32_t leaf;
  std::uint16_t box;
  std::uint8_t triangles;
};
static_assert(sizeof(LeafHit) == 8);

/// The walk of up to kBoxGroup boxes, which pauses whenever the room for its hits is full. Lives on
/// the caller's stack; the walk writes only the part it uses.
struct BvhWalk {
  /// Depth first, a node leaves at most seven others waiting on each level.
  static constexpr int kNodeRoom = (kBvhWidth - 1) * kMaxBvhDepth + kBvhWidth;
  static constexpr int kLeafRoom = 256;
  static constexpr int kHitRoom = 512;
  static_assert(kLeafRoom >= kBvhWidth && kHitRoom >= kBoxGroup);

  struct Entry {
    std::uint64_t alive;  ///< Bit b: box b meets the node or leaf.
    std::uint32_t target;
  };

  const BvhNode* nodes;
  const Cluster* clusters;  ///< The caller reads a hit leaf's cluster first.
  int firstBox;             ///< Added to the boxes of the hits.

  // Copied from the caller's boxes, the rest empty; their union.
  int vectorsOfBoxes;
  alignas(64) float lower[3][kBoxGroup];
  alignas(64) float upper[3][kBoxGroup];
  float unionLower[3], unionUpper[3];

  int nodesWaiting, leavesWaiting, leavesDone, hitCount;
  std::uint64_t nodesVisited, leavesVisited;
  Entry waiting[kNodeRoom];
  Entry leaf[kLeafRoom];
  LeafHit hit[kHitRoom];

  [[nodiscard]] bool finished() const { return nodesWaiting == 0 && leavesDone == leavesWaiting; }
};

/// Starts at the root with the boxes from `first` on, at most kBoxGroup of them.
void beginWalk(BvhWalk& walk, const BoxLanes& boxes, int first);
/// Replaces walk.hit[0..hitCount) by the next hits. Until finished().
void continueWalk(BvhWalk& walk);

}  // namespace foretouch::internal
