// bench/stream_command.h: `foretouch-bench stream` and `foretouch-bench soak`.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/stream.h"
#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// "10x90,1x1000": ten senders of 90 poses a second, one of 1,000. Errors name the option.
[[nodiscard]] Result<std::vector<StreamCrowd>> parseCrowds(const std::string& option,
                                                           const std::string& text);

/// Adds the subcommands to `foretouch bench`; their exit code goes to `exit`.
void addBenchStreamCommands(CLI::App& bench, ExitCode& exit);

}  // namespace foretouch::tools
