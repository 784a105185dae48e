// tools/setup/placement_check.h: what is right and what is wrong about unit, axis and place, as the
// engine finds it: the ticks of `foretouch view` and of `foretouch setup`.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/check_list.h"
#include "tools/setup/standing.h"

namespace foretouch::tools {

/// Start, floor, level and path. `better`: where the body could stand; nullptr if this was not
/// looked for, or there is no such place.
[[nodiscard]] std::vector<PlacementCheck> checksOf(const Walker& walker, const Standing& standing,
                                                   const Standing* better);

/// True if nothing is wrong; doubts may be left.
[[nodiscard]] bool areUsable(const std::vector<PlacementCheck>& checks);

/// True if a better place should be looked for.
[[nodiscard]] bool isWrong(const Standing& standing);

/// "X,Y,Z,YAW", as --place takes it.
[[nodiscard]] std::string textOf(const Placement& place);

}  // namespace foretouch::tools
