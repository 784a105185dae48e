// tools/settings/command_line.h: commands as data. Only the source that reads the command line into
// them depends on the parsing library.
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

/// A subcommand of the program, or of another command.
struct Command {
  std::string name, purpose;
  std::string examples = {};  ///< The end of its help.
  Settings settings = {};
  /// Called once the settings hold the given values, all legal. `settings` are these.
  std::function<ExitCode(const Settings& settings)> run = {};
  /// Takes what its command line does not say from a project file: --project, or the foretouch.toml
  /// of the current folder if the command line names no file at all.
  bool takesProject = false;
  std::vector<Command> commands = {};  ///< Subcommands; the user must name one if there are any.
  std::string group = {};              ///< Its group in the list of commands; empty: "Commands".
  /// Not empty: the command is gone, and naming it prints this text.
  std::string isGone = {};
};

/// Adds a command to a program. Its exit code goes to `exit`, which must outlive `program`. The
/// first illegal value ends it, with an error that names the option.
void addCommand(CLI::App& program, Command command, ExitCode& exit);

}  // namespace foretouch::tools
