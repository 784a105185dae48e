// tools/commands/commands.h: all commands of `foretouch`.
#pragma once

#include "tools/program.h"

namespace foretouch::tools {

void addCommands(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
