// tools/commands/completion.h: scripts that complete the program's commands, options and values in
// a shell, made of the commands' own data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/settings/command_line.h"

namespace foretouch::tools {

enum class Shell : std::uint8_t { Bash, Zsh, Fish };

/// An option, or an argument.
struct Completable {
  std::vector<std::string> names;  ///< "-o", "--output"; none: an argument.
  std::string help;
  std::vector<std::string> words;  ///< All legal values, where these are few.
  std::string endings;             ///< The endings of files: "bvh glb"; empty: any.
  bool takesValue = false, takesFiles = false;
};

/// The program itself, or one of its commands.
struct CompletableCommand {
  std::vector<std::string> path;  ///< "avatar", "check"
  std::string purpose;
  std::vector<Completable> options, arguments;
};

/// The program first, then its commands, each before its subcommands, then what every program has:
/// `help`, `man` and `version`.
[[nodiscard]] std::vector<CompletableCommand> completableCommands(
    const std::vector<Command>& commands);

[[nodiscard]] std::string completionScript(Shell shell,
                                           const std::vector<CompletableCommand>& commands);

}  // namespace foretouch::tools
