// tools/batch/batch_command.h: `foretouch batch`.
#pragma once

#include <functional>

#include "tools/settings/command_line.h"

namespace foretouch::tools {

/// `replay`, `feet`: make these commands, whose options a job takes.
[[nodiscard]] Command batchCommand(std::function<Command()> replay, std::function<Command()> feet);

}  // namespace foretouch::tools
