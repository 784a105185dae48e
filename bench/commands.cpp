#include "bench/commands.h"

namespace foretouch::tools {

void addBenchCommands(CLI::App& program, ExitCode& exit) {
  for (const auto command :
       {latencyCommand, scalingCommand, reportCommand, instructionsCommand, memoryCommand,
        compareCommand, leafCommand, peersCommand, extremesCommand, streamCommand, soakCommand,
        deadlineCommand, treesCommand, tradeCommand, solidBenchCommand, worldBenchCommand,
        tuneCommand, bodyCommand, askBenchCommand}) {
    addCommand(program, command(), exit);
  }
}

}  // namespace foretouch::tools
