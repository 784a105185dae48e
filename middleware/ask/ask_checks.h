// middleware/ask/ask_checks.h: what every question refuses by name. Not installed.
#pragma once

#include "articulated/result.h"
#include "lss/lss.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

[[nodiscard]] Result<Done> checkedShape(const Lss& shape);
/// `where`: the question's part.
[[nodiscard]] Result<Done> checkedTime(const WorldParts& world, const WorldTime& time,
                                       const char* where);

}  // namespace foretouch::internal
