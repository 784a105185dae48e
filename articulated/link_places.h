// articulated/link_places.h: where a pose has the links. Metres in the world W. Not installed.
#pragma once

#include <vector>

#include "articulated/motion.h"
#include "articulated/skeleton.h"

namespace foretouch {

/// The links' states, without velocities: those of any motion that begins or ends there, to within
/// the same bounds on rounding. `states` is resized. O(joints), no trigonometry.
void placesAt(const Skeleton& skeleton, const Pose& pose, std::vector<LinkState>& states);

}  // namespace foretouch
