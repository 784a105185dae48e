// tools/inputs/t_pose.h: the T-pose that many clips begin with: calibration, not motion.
#pragma once

#include <cstdint>

#include "articulated/clip.h"

namespace foretouch::tools {

/// How many frames at the clip's begin are a T-pose: both arms straight, level and away from each
/// other, by the joints' names. 0 if it begins otherwise, or if the names show no arms. `isZUp`:
/// the clip's z points up.
[[nodiscard]] std::int64_t tPoseFramesOf(const Clip& clip, bool isZUp);

}  // namespace foretouch::tools
