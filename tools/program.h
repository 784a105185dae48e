// tools/program.h: the `foretouch` program as a function.
#pragma once

namespace foretouch::tools {

/// Parses the command line, runs the subcommand and returns the exit code: 0 done, 1 a check said
/// no, 2 bad use or bad input. Throws nothing.
[[nodiscard]] int runProgram(int argc, const char* const* argv) noexcept;

}  // namespace foretouch::tools
