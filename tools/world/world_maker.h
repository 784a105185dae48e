// tools/world/world_maker.h: gives the world of a file the places of its bodies, change by change.
#pragma once

#include <vector>

#include "articulated/result.h"
#include "tools/world/body_knots.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Fills the stretches of the bodies, gives them to `loaded.world`, and finds from when to when it
/// is known. `knots`: one per body. The result depends on what the file says, not on the order
/// of its bodies. Errors name the file and the line.
[[nodiscard]] Result<Done> tellWorld(LoadedWorld& loaded, std::vector<BodyKnots> knots);

}  // namespace foretouch::tools
