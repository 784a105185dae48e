// tools/bench/command.h: `foretouch bench`, and its subcommand `leaf`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; what it ends with goes to `exit`, which must outlive `program`.
void addBenchCommand(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
