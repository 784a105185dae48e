// tools/help_page.h: what the help of a command says, as data: a terminal and a manual page show
// it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace foretouch::tools {

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

struct HelpPage {
  std::string command;  ///< "foretouch avatar check"
  std::string purpose;
  std::string usage;
  std::vector<HelpGroup> groups;
  /// Paragraphs and examples: a line that is indented is a command and goes on behind a backslash.
  std::string footer;
};

/// The option_text() of an option that the program itself requires, later than the parser would.
inline constexpr char kRequired[] = "required";

/// Arguments first, then commands, then options by groups in the order of their first one,
/// "General" last.
[[nodiscard]] HelpPage helpPageOf(const CLI::App& app);

/// "foretouch avatar check"
[[nodiscard]] std::string wordsOf(const CLI::App& app);

/// All commands below an app that help lists, by name: its own, and those of its commands.
[[nodiscard]] std::vector<const CLI::App*> listedCommands(const CLI::App& app);

}  // namespace foretouch::tools
