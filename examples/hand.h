// examples/hand.h: an arm whose hand presses on a desk, slides along it and leaves it again: for
// avatars that pass through nothing.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// One arm from its shoulder on, an LSS per link. At rest it is stretched along +X, palm down.
[[nodiscard]] Result<Avatar> handAvatar();

inline constexpr double kHandDurationS = 4.6;
/// The tracked pose, with no respect for the desk: from 1 to 3.6 s the palm is 6 cm inside.
[[nodiscard]] Pose handPoseAt(const Skeleton& arm, double timeS);

/// A desk with a drawer box below it, on a floor.
void addDesk(MeshBuilder& mesh);
inline constexpr double kDeskTop = 0.74;  ///< Metres above the floor.

}  // namespace foretouch::examples
