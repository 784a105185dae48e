// tools/feet/feet_command.h: `foretouch feet`.
#pragma once

#include "tools/feet/feet_inputs.h"
#include "tools/settings/command_line.h"

namespace foretouch::tools {

/// The clip, its body, its ground and what touches it; `request` outlives the settings.
void addFeetSettings(Settings& settings, FeetRequest& request);

[[nodiscard]] Command feetCommand();

}  // namespace foretouch::tools
