// tools/world/file_triggers.h: the triggers of a world file, as those of its world.
#pragma once

#include "articulated/result.h"
#include "tools/world/body_shapes.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Adds one to the loaded world's. Errors name the file and the trigger's line.
[[nodiscard]] Result<Done> addTrigger(const FileBody& file, const BodyShape& shape,
                                      LoadedWorld& loaded);

/// Tells all triggers whom they look at. Errors name the file and the line.
[[nodiscard]] Result<Done> watchAll(LoadedWorld& loaded);

}  // namespace foretouch::tools
