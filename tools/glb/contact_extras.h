// tools/glb/contact_extras.h: the data of a touch in a GLB.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "middleware/scene/scene.h"
#include "tools/glb/shown_touch.h"

namespace foretouch::tools {

/// "LeftHand at table, 1.003 s". Precondition of both: a touch of the scene (with a triangle).
[[nodiscard]] std::string contactTitle(const ShownTouch& shown, const Skeleton& skeleton,
                                       const Scene& scene);

/// The fields of the first contact as in a results file (docs/formats.md, "Results"), `step`,
/// `missed_by_poses` (for a solid avatar `push` instead), and the touch's own as `touch`.
[[nodiscard]] nlohmann::json contactExtras(const ShownTouch& shown, const Skeleton& skeleton,
                                           const Scene& scene);

}  // namespace foretouch::tools
