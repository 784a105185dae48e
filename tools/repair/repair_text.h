// tools/repair/repair_text.h: what a repair did, for people and as JSON.
#pragma once

#include <string>

#include "tools/repair/repair.h"

namespace foretouch::tools {

[[nodiscard]] std::string repairText(const RepairStage& stage, const Repair& repair);
[[nodiscard]] std::string repairJson(const RepairStage& stage, const Repair& repair);

}  // namespace foretouch::tools
