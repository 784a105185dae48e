// tools/commands/demo_command.h: `foretouch demo`: the bundled example, end to end.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; what it ends with goes to `exit`, which must outlive `program`.
void addDemoCommand(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
