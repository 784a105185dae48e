// middleware/exact/within_distance.h: is a point within a distance of a triangle? Exact. Metres.
// Not installed.
#pragma once

#include <Eigen/Core>

#include "lss/lss.h"

namespace foretouch::internal {

/// Also exactly at the distance, and for the coordinates as they are; degenerate triangles
/// included. A plane decides where it can, integers the rest: nanometres from a triangle of a
/// metre, a plane is tilted by rounding and proves nothing. All coordinates finite, |coordinate| <=
/// 1e100, distance >= 0.
[[nodiscard]] bool isWithin(const Eigen::Vector3d& p, const Triangle& triangle, double distance);

}  // namespace foretouch::internal
