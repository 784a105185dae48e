// tools/audit/avatar_command.h: `foretouch avatar` and its subcommands.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommands; what they end with goes to `exit`, which must outlive `program`.
void addAvatarCommand(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
