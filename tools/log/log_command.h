// tools/log/log_command.h: `foretouch log` and its subcommands.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command logCommand();

}  // namespace foretouch::tools
