// tools/log/log_convert_command.h: `foretouch log convert`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand to `log`; what it ends with goes to `exit`, which must outlive `log`.
void addLogConvertCommand(CLI::App& log, ExitCode& exit);

}  // namespace foretouch::tools
