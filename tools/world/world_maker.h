// tools/world/world_maker.h: tells the world of a file where everybody is, change after change.
#pragma once

#include <vector>

#include "articulated/result.h"
#include "tools/world/body_knots.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Fills the stretches of the bodies, tells `loaded.world` the same, and finds from when to when it
/// is known. `knots`: one per body. What comes out depends on what the file says, not on the order
/// of its bodies. Errors name the file and the line.
[[nodiscard]] Result<Done> tellWorld(LoadedWorld& loaded, std::vector<BodyKnots> knots);

}  // namespace foretouch::tools
