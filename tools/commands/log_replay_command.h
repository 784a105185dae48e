// tools/commands/log_replay_command.h: `foretouch log replay`: answers what a service with a moving
// world recorded, and compares all of it with the service's answers.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command logReplayCommand();

}  // namespace foretouch::tools
