// tools/commands/demo_command.h: `foretouch demo`: the bundled example, end to end.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command demoCommand();

}  // namespace foretouch::tools
