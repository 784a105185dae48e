// bench/solid/followers.h: what is measured side by side: the solid avatar, and the usual way:
// hold back the limb that touches, and ask again.
#pragma once

#include <memory>

#include "bench/solid/feel.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::tools {

/// The skin of holdingFollower(), wherever it is measured (m).
inline constexpr double kHoldSkin = 4e-3;

/// Errors: those of SolidAvatar::build().
[[nodiscard]] Result<std::unique_ptr<Follower>> solidFollower(const Avatar& avatar,
                                                              const Scene& scene,
                                                              const SolidOptions& options);

/// Asks for the motion from the shown pose to the tracked one; a link that touches holds its limb
/// where it is, its joints' places on their parents, or the limb above if that is held already; and
/// asks again, at most once per limb. The rest of the body moves. Every motion that it shows is
/// proven. The first pose must be free.
[[nodiscard]] Result<std::unique_ptr<Follower>> holdingFollower(const Avatar& avatar,
                                                                const Scene& scene, double skin);

}  // namespace foretouch::tools
