#include "bench/commands.h"

#include <CLI/CLI.hpp>

#include "bench/cage_command.h"
#include "bench/compare_command.h"
#include "bench/deadline_command.h"
#include "bench/documents_command.h"
#include "bench/extremes_command.h"
#include "bench/latency_command.h"
#include "bench/leaf_command.h"
#include "bench/memory_command.h"
#include "bench/peers_command.h"
#include "bench/scaling_command.h"
#include "bench/solid_command.h"
#include "bench/stream_command.h"
#include "bench/trade_command.h"
#include "bench/trees_command.h"
#include "bench/trust_command.h"
#include "bench/tune_command.h"
#include "bench/view_command.h"
#include "bench/world_command.h"

namespace foretouch::tools {

void addBenchCommands(CLI::App& program, ExitCode& exit) {
  addBenchLatencyCommand(program, exit);
  addBenchScalingCommand(program, exit);
  addCommand(program, compareCommand(), exit);
  addBenchDocumentCommands(program, exit);
  addBenchMemoryCommand(program, exit);
  addBenchLeafCommand(program, exit);
  addBenchPeersCommand(program, exit);
  addBenchExtremesCommand(program, exit);
  addBenchStreamCommands(program, exit);
  addBenchViewCommand(program, exit);
  addBenchDeadlineCommand(program, exit);
  addBenchCageCommand(program, exit);
  addBenchTreesCommand(program, exit);
  addBenchTrustCommand(program, exit);
  addBenchTradeCommand(program, exit);
  addBenchSolidCommand(program, exit);
  addBenchWorldCommand(program, exit);
  addTuneCommand(program, exit);
}

}  // namespace foretouch::tools
