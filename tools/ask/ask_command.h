// tools/ask/ask_command.h: `foretouch ask`: what a ray, a shape on its way or a shape at rest meets
// in the world of a world file, at one instant.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command askCommand();

}  // namespace foretouch::tools
