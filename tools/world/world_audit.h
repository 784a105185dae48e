// tools/world/world_audit.h: what a world holds, for `foretouch world check`.
#pragma once

#include <string>
#include <vector>

#include "tools/world/world_windows.h"

namespace foretouch::tools {

/// Aligned lines. `overlaps`: those of overlapsAtStart().
[[nodiscard]] std::string describe(const LoadedWorld& world,
                                   const std::vector<WorldContact>& overlaps);
/// The same as one line of JSON.
[[nodiscard]] std::string auditLine(const LoadedWorld& world,
                                    const std::vector<WorldContact>& overlaps);

}  // namespace foretouch::tools
