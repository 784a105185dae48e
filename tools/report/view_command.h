// tools/report/view_command.h: `foretouch view`: shows inputs before a run.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command viewCommand();

}  // namespace foretouch::tools
