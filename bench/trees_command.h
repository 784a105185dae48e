// bench/trees_command.h: `foretouch-bench trees`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; its exit code goes to `exit`, which must outlive `bench`.
void addBenchTreesCommand(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
