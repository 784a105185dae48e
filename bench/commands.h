// bench/commands.h: all commands of `foretouch-bench`.
#pragma once

#include "tools/program.h"

namespace foretouch::tools {

void addBenchCommands(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
