// tools/log/log_convert_command.h: `foretouch log convert`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command logConvertCommand();

}  // namespace foretouch::tools
