// tools/audit/scene_command.h: `foretouch scene check`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command sceneCommand();

}  // namespace foretouch::tools
