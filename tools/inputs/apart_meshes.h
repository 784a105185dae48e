// tools/inputs/apart_meshes.h: own links that nobody asks about because their LSS always touch,
// though their meshes do not.
#pragma once

#include <optional>
#include <string>

#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {

/// Of a replay at exact fidelity whose pair rules are derived: how many pairs these are, by some
/// poses of the clip, and how to ask about them. Nothing if there are none.
[[nodiscard]] std::optional<std::string> remarkOnApartMeshes(const ReplayInputs& inputs);

}  // namespace foretouch::tools
