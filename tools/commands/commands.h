// tools/commands/commands.h: `foretouch`, with all its commands.
#pragma once

#include "tools/program.h"

namespace foretouch::tools {

/// The `foretouch` program; see runProgram().
[[nodiscard]] int runForetouch(int argc, const char* const* argv) noexcept;

}  // namespace foretouch::tools
