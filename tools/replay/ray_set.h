// tools/replay/ray_set.h: the rays that latencies are compared to.
#pragma once

#include <array>

#include "articulated/motion.h"
#include "middleware/scene/ray_yardstick.h"

namespace foretouch::tools {

/// Each is the way of one link's origin from pose to pose, the line of a ray cast between the
/// poses. Repeats links if there are fewer than rays; takes the first ones if there are more.
[[nodiscard]] std::array<RaySegment, kRaysPerSet> raysAlong(const ChainMotion& motion);

}  // namespace foretouch::tools
