// tools/colliders/avatar_colliders_command.h: `foretouch avatar colliders`, an avatar's LSS as
// colliders of other tools.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command avatarCollidersCommand();

}  // namespace foretouch::tools
