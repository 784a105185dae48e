// middleware/exact/ray_up.h: does the ray straight up from a point cross a triangle? Exact, and of
// one mind about the edges that triangles share. Not installed.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "lss/lss.h"

namespace foretouch::internal {

enum class RayUp : std::uint8_t {
  Misses,
  Crosses,
  Touches,  ///< The point is on the triangle, or was taken to be.
};

/// The ray along +Z from p moved aside by (d, d^2) for a d that is above 0 and as small as need be:
/// it passes beside every corner and edge that is exactly above p, always on the same side. So of a
/// surface without a border, and a point that is not on it, the crossings are odd in number exactly
/// if the point is inside ([Edelsbrunner90]). All coordinates finite, |coordinate| <= 1e100.
[[nodiscard]] RayUp rayUp(const Eigen::Vector3d& p, const Triangle& triangle);

}  // namespace foretouch::internal
