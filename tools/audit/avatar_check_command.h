// tools/audit/avatar_check_command.h: `foretouch avatar check`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}  // namespace CLI

namespace foretouch::tools {

void addAvatarCheckCommand(CLI::App& avatar, ExitCode& exit);

}  // namespace foretouch::tools
