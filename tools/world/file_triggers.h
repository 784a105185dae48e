// tools/world/file_triggers.h: the triggers of a world file, as those of its world.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/triggers/triggers.h"
#include "middleware/world/world.h"
#include "tools/world/body_shapes.h"
#include "tools/world/world_file.h"

namespace foretouch::tools {

/// Adds one to the world's. Errors name the file at `path` and the trigger's line.
[[nodiscard]] Result<Done> addTrigger(const FileBody& file, const BodyShape& shape,
                                      const std::string& path, World& world, Triggers& triggers);

/// Sets for all triggers what they look at; `skeletons`: of every body, by its BodyId. Errors name
/// the file and the line.
[[nodiscard]] Result<Done> watchAll(const WorldFile& file,
                                    const std::vector<const Skeleton*>& skeletons,
                                    const World& world, Triggers& triggers);

}  // namespace foretouch::tools
