// tools/solid/solid_command.h: `foretouch solid`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command solidCommand();

}  // namespace foretouch::tools
