// tools/report/view_command.h: `foretouch view`: inputs looked at before a run.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command viewCommand();

}  // namespace foretouch::tools
