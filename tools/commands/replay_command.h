// tools/commands/replay_command.h: `foretouch replay`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command replayCommand();

}  // namespace foretouch::tools
