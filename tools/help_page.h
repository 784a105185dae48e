// tools/help_page.h: what the help of a command says, as data: a terminal and a manual page show
// it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace foretouch::tools {

/// The title of the commands about commands, and of what every command takes.
inline constexpr char kHelpGroup[] = "Help", kGeneralGroup[] = "General";

struct HelpOption {
  std::string names;        ///< "-o,--output"; of an argument: its name. No former names.
  std::string value;        ///< "FILE"; empty for a flag and an argument without a placeholder.
  std::string text;         ///< One sentence, with what is required and what it needs.
  std::string defaultText;  ///< Empty: none.
  bool isRequired = false;
  bool isArgument = false;
};

/// Options, or commands, under a title.
struct HelpGroup {
  std::string title;
  std::vector<HelpOption> entries;
};

/// A paragraph, or a command to type: on one line, however long.
struct HelpBlock {
  bool isCommand = false;
  std::string text;
};

struct HelpPage {
  std::string command;  ///< "foretouch avatar check"
  std::string purpose;
  std::string usage;
  std::vector<HelpGroup> groups;
  std::vector<HelpBlock> footer;
};

/// The option_text() of an option that the program itself requires, later than the parser would.
inline constexpr char kRequired[] = "required";

/// Commands first, then arguments, then options by groups in the order of their first one,
/// "General" last; the program itself ends with its exit codes. In a footer, an indented line is a
/// command and goes on behind a backslash.
[[nodiscard]] HelpPage helpPageOf(const CLI::App& app);

/// "foretouch avatar check"
[[nodiscard]] std::string wordsOf(const CLI::App& app);

/// All commands below an app that help lists, by name: its own, and those of its commands.
[[nodiscard]] std::vector<const CLI::App*> listedCommands(const CLI::App& app);

}  // namespace foretouch::tools
