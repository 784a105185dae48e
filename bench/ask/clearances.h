// bench/ask/clearances.h: how near a robot's edges come to a scene: what an answer costs, and
// whether its bounds hold.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

/// A Panda on a table's height amid the bundled room, cut into so many triangles; some of the edges
/// are judged. A violation is a bound that does not hold. No rows if the folder has no such robot.
/// Errors name a file.
[[nodiscard]] Result<JudgedTable> clearancesTable(const std::string& dataFolder, int triangles,
                                                  int edges, std::uint64_t seed);

}  // namespace foretouch::tools
