// tools/setup/setup_command.h: `foretouch setup`: settles unit, axis and place of a scene and a
// body, and writes the project file that other commands take.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command setupCommand();

}  // namespace foretouch::tools
