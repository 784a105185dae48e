// tools/log/log_inspect_command.h: `foretouch log info` and `foretouch log check`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

void addLogInfoCommand(CLI::App& log, ExitCode& exit);
void addLogCheckCommand(CLI::App& log, ExitCode& exit);

}  // namespace foretouch::tools
