// tools/log/log_recover_command.h: `foretouch log recover`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

void addLogRecoverCommand(CLI::App& log, ExitCode& exit);

}  // namespace foretouch::tools
