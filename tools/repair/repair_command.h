// tools/repair/repair_command.h: `foretouch repair`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command repairCommand();

}  // namespace foretouch::tools
