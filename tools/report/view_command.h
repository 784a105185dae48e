// tools/report/view_command.h: `foretouch view`: inputs looked at before a run.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; what it ends with goes to `exit`, which must outlive `program`.
void addViewCommand(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
