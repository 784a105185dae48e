// tools/audit/avatar_make_command.h: `foretouch avatar bvh`, `mesh` and `urdf`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command avatarBvhCommand();
[[nodiscard]] Command avatarMeshCommand();
[[nodiscard]] Command avatarUrdfCommand();

}  // namespace foretouch::tools
