// bench/trust_command.h: `foretouch-bench trust`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

void addBenchTrustCommand(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
