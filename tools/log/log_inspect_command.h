// tools/log/log_inspect_command.h: `foretouch log info` and `foretouch log check`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command logInfoCommand();
[[nodiscard]] Command logCheckCommand();

}  // namespace foretouch::tools
