// tools/audit/avatar_command.h: `foretouch avatar` and its subcommands.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command avatarCommand();

}  // namespace foretouch::tools
