// tools/sweep/sweep_command.h: `foretouch sweep`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command sweepCommand();

}  // namespace foretouch::tools
