// bench/peers_command.h: `foretouch-bench peers`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand to `bench`; its exit code goes to `exit`, which must outlive it.
void addBenchPeersCommand(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
