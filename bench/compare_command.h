// bench/compare_command.h: `foretouch-bench compare`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command compareCommand();

}  // namespace foretouch::tools
