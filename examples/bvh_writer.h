// examples/bvh_writer.h: poses as a BVH file in metres.
#pragma once

#include <string>
#include <vector>

#include "articulated/skeleton.h"

namespace foretouch::examples {

/// Rest rotations must be identities and joints in depth-first order, as in BVH. The root gets
/// position channels; every joint Z X Y rotations, in degrees without jumps of a turn between
/// frames. Positions to 10 micrometres, angles to 1e-4 degrees. A joint without children gets an
/// End Site of its own (metres, in its frame) from `tips`.
[[nodiscard]] std::string bvhText(const Skeleton& skeleton,
                                  const std::vector<Eigen::Vector3d>& tips,
                                  const std::vector<Pose>& frames, double frameTimeS);

}  // namespace foretouch::examples
