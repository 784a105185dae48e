// tools/log/log_recover_command.h: `foretouch log recover`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command logRecoverCommand();

}  // namespace foretouch::tools
