// tools/log/bvh_text.h: poses as a BVH file, with all their digits.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch::tools {

/// Joints in depth-first order, in metres; Z X Y rotations, positions of roots and of the joints
/// that `hasTranslation` names. An End Site of no length ends each chain. Reads the text back to
/// check it: names and translations are equal, rotations within kBvhTurn. Errors: content that a
/// BVH file cannot hold (Error::index is the joint), sizes that the reader refuses. Precondition:
/// validated poses of the skeleton.
[[nodiscard]] Result<std::string> bvhText(const Skeleton& skeleton,
                                          const std::vector<bool>& hasTranslation,
                                          const std::vector<Pose>& poses, double frameTimeS);

/// The largest change of a rotation through a BVH file (radians).
inline constexpr double kBvhTurn = 1e-9;

}  // namespace foretouch::tools
