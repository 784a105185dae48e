// bench/deadline_command.h: `foretouch-bench deadline`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand to `foretouch bench`; its exit code goes to `exit`.
void addBenchDeadlineCommand(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
