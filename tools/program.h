// tools/program.h: a program with subcommands, as a function: `foretouch`, and `foretouch-bench`.
#pragma once

#include <functional>

#include "tools/console.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

struct ProgramText {
  const char* name;
  const char* purpose;  ///< The beginning of --help.
  const char* start;    ///< The end of --help.
};

/// Adds the program's commands; each sets `exit` when it has run.
using AddCommands = std::function<void(CLI::App& program, ExitCode& exit)>;

/// Parses the command line, runs the subcommand and returns the exit code: 0 done, 1 a check
/// failed, 2 bad use or bad input. Throws nothing.
[[nodiscard]] int runProgram(const ProgramText& text, const AddCommands& addCommands, int argc,
                             const char* const* argv) noexcept;

}  // namespace foretouch::tools
