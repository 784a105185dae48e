// bench/tune_command.h: `foretouch-bench tune`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; its exit code goes to `exit`, which must outlive `program`.
void addTuneCommand(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
