// tools/replay/ray_set.h: the rays that latencies are compared with.
#pragma once

#include <array>

#include "articulated/motion.h"
#include "middleware/scene/ray_yardstick.h"

namespace foretouch::tools {

/// The way of one link's origin each, from pose to pose: what a ray cast between the poses would
/// look along. Links repeat where there are fewer than rays, and the first are taken of more.
[[nodiscard]] std::array<RaySegment, kRaysPerSet> raysAlong(const ChainMotion& motion);

}  // namespace foretouch::tools
