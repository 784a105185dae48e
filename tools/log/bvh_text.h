// tools/log/bvh_text.h: poses as a BVH file, with all the digits that they have.
#pragma once

#include <string>
#include <vector>

#include "articulated/pose.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch::tools {

/// Joints in depth-first order, in metres; Z X Y rotations, positions of roots and of the joints
/// that `hasTranslation` names. An End Site of no length ends each chain. The text has been read
/// back: names and translations the same, rotations within kBvhTurn. Errors: what a BVH file cannot
/// hold (Error::index is the joint), sizes that the reader refuses. The poses are validated ones of
/// the skeleton.
[[nodiscard]] Result<std::string> bvhText(const Skeleton& skeleton,
                                          const std::vector<bool>& hasTranslation,
                                          const std::vector<Pose>& poses, double frameTimeS);

/// Radians: what a rotation may turn by on its way through a BVH file.
inline constexpr double kBvhTurn = 1e-9;

}  // namespace foretouch::tools
