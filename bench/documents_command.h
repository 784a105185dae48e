// bench/documents_command.h: `foretouch-bench report` and `foretouch-bench instructions`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds both subcommands; their exit code goes to `exit`, which must outlive `bench`.
void addBenchDocumentCommands(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
