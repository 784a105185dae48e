// tools/stream/listen_command.h: `foretouch listen`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command listenCommand();

}  // namespace foretouch::tools
