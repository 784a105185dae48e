// middleware/scene/culler.h: which triangles may be near a box. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "lss/triangle.h"
#include "middleware/scene/triangle_id.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// Returns a superset of the triangles whose double-precision boxes overlap the given box. The
/// caller's own double test drops the superfluous ones, so every culler leads to the same answer.
class TriangleCuller {
 public:
  virtual ~TriangleCuller() = default;
  /// Appends ids, in any order, each at most once. `visited` counts the culler's work.
  virtual void collect(const Aabb& box, std::vector<TriangleId>& ids,
                       std::uint64_t& visited) const = 0;
};

/// Box of a triangle, exact.
[[nodiscard]] Aabb boxOf(const Triangle& triangle);

}  // namespace foretouch::internal
