// tools/audit/avatar_check_command.h: `foretouch avatar check`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command avatarCheckCommand();

}  // namespace foretouch::tools
