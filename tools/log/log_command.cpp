#include "tools/log/log_command.h"

#include "tools/log/log_convert_command.h"
#include "tools/log/log_inspect_command.h"
#include "tools/log/log_recover_command.h"

namespace foretouch::tools {

Command logCommand() {
  Command log{"log", "Look into, check and mend event logs"};
  for (const auto command :
       {logInfoCommand, logCheckCommand, logRecoverCommand, logConvertCommand}) {
    log.commands.push_back(command());
  }
  return log;
}

}  // namespace foretouch::tools
