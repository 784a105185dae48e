// tools/world/load_world.h: reads the world of a world file, with all that the file names.
#pragma once

#include "articulated/result.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Errors name the file and, if it is the world's, the line.
[[nodiscard]] Result<LoadedWorld> loadWorld(WorldFile file);

}  // namespace foretouch::tools
