// bench/commands.h: all commands of `foretouch-bench`.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command askBenchCommand();
[[nodiscard]] Command bodyCommand();
[[nodiscard]] Command compareCommand();
[[nodiscard]] Command deadlineCommand();
[[nodiscard]] Command extremesCommand();
[[nodiscard]] Command instructionsCommand();
[[nodiscard]] Command latencyCommand();
[[nodiscard]] Command leafCommand();
[[nodiscard]] Command memoryCommand();
[[nodiscard]] Command peersCommand();
[[nodiscard]] Command reportCommand();
[[nodiscard]] Command scalingCommand();
[[nodiscard]] Command soakCommand();
[[nodiscard]] Command solidBenchCommand();
[[nodiscard]] Command streamCommand();
[[nodiscard]] Command tradeCommand();
[[nodiscard]] Command treesCommand();
[[nodiscard]] Command tuneCommand();
[[nodiscard]] Command worldBenchCommand();

void addBenchCommands(CLI::App& program, ExitCode& exit);

}  // namespace foretouch::tools
