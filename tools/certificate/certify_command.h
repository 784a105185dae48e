// tools/certificate/certify_command.h: `foretouch certify`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command certifyCommand();

}  // namespace foretouch::tools
