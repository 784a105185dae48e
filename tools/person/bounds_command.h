// tools/person/bounds_command.h: the command `bounds`: how far persons are from a model of their
// motion, learned from clips.
#pragma once

#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command boundsCommand();

}  // namespace foretouch::tools
