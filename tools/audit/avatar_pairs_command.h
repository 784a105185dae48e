// tools/audit/avatar_pairs_command.h: `foretouch avatar pairs`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command avatarPairsCommand();

}  // namespace foretouch::tools
