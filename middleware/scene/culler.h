// middleware/scene/culler.h: which triangles may be near a box, or near many boxes. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "lss/lss.h"
#include "middleware/scene/raw_scene.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

struct BoxLanes;
struct LeafHit;

/// The scene's flat tree (flat_bvh.h) in every query of the product; tests put others in its place.
class TriangleCuller {
 public:
  virtual ~TriangleCuller() = default;
  /// Appends a superset of the triangles whose double-precision boxes overlap the given box, in any
  /// order, each at most once. The caller's own double test drops the superfluous ones, so every
  /// culler leads to the same answer. `visited` counts the culler's work.
  virtual void collect(const Aabb& box, std::vector<TriangleId>& ids,
                       std::uint64_t& visited) const = 0;
  /// The same for many boxes, which are relative to the scene's origin: appends leaves of the flat
  /// tree, each at most once per box. Adds to both counters.
  virtual void collectLeaves(const BoxLanes& boxes, std::vector<LeafHit>& hits,
                             std::uint64_t& nodesVisited, std::uint64_t& leavesVisited) const = 0;
};

/// Box of a triangle, exact.
[[nodiscard]] Aabb boxOf(const Triangle& triangle);

}  // namespace foretouch::internal
