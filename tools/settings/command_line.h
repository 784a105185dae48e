// tools/settings/command_line.h: commands as data. What reads the command line into them is the only source
// of `foretouch` that knows the library which does it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/console.h"
#include "tools/settings/settings.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// A subcommand: of the program, or of another one.
struct Command {
  std::string name, purpose;
  std::string examples = {};  ///< What its help ends with.
  Settings settings = {};
  /// Called once the settings hold what was given, all of it legal. `settings` are these.
  std::function<ExitCode(const Settings& settings)> run = {};
  std::vector<Command> commands = {};  ///< Of which one is to be named, where there are any.
  /// Not empty: the command is gone, and whoever names it is told this.
  std::string isGone = {};
};

/// Adds a command to a program; what it ends with goes to `exit`, which must outlive `program`. The
/// first value that is not legal ends it, with an error that names the option.
void addCommand(CLI::App& program, Command command, ExitCode& exit);

}  // namespace foretouch::tools
