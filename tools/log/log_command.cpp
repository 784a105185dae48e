#include "tools/log/log_command.h"

#include <CLI/CLI.hpp>

#include "tools/log/log_convert_command.h"
#include "tools/log/log_inspect_command.h"
#include "tools/log/log_recover_command.h"

namespace foretouch::tools {

void addLogCommand(CLI::App& program, ExitCode& exit) {
  CLI::App* const log = program.add_subcommand("log", "Look into, check and mend event logs");
  log->require_subcommand(1);
  addLogInfoCommand(*log, exit);
  addLogCheckCommand(*log, exit);
  addLogRecoverCommand(*log, exit);
  addLogConvertCommand(*log, exit);
}

}  // namespace foretouch::tools
