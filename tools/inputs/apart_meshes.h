// tools/inputs/apart_meshes.h: own links that nobody asks about because their LSS always touch,
// though their meshes do not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Of a query at exact fidelity with derived pair rules: which pairs these are, by `poses` of the
/// avatar, and how to ask about them. Nothing if there are none, or if it is no such query.
[[nodiscard]] std::optional<std::string> remarkOnApartMeshes(const Avatar& avatar,
                                                             const Scene& scene,
                                                             const QueryOptions& query,
                                                             const std::vector<Pose>& poses);

}  // namespace foretouch::tools
