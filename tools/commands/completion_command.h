// tools/commands/completion_command.h: `foretouch completion`.
#pragma once

#include <functional>
#include <vector>

#include "tools/settings/command_line.h"

namespace foretouch::tools {

/// `all`: makes the program's commands, this one included.
[[nodiscard]] Command completionCommand(std::function<std::vector<Command>()> all);

}  // namespace foretouch::tools
