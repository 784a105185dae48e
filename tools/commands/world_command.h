// tools/commands/world_command.h: `foretouch world check|replay|view`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command worldCommand();

}  // namespace foretouch::tools
