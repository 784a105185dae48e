// tools/feet/feet_command.h: `foretouch feet`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command feetCommand();

}  // namespace foretouch::tools
