// tools/log/log_command.h: `foretouch log` and its subcommands.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommands; what they end with goes to `exit`, which must outlive `program`.
void addLogCommand(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
