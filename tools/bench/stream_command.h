// tools/bench/stream_command.h: `foretouch bench stream` and `foretouch bench soak`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommands to `foretouch bench`; what they end with goes to `exit`.
void addBenchStreamCommands(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
