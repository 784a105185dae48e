// tools/usage_error.h: what is wrong with a command line that cannot be parsed, and what its user
// may have meant.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace foretouch::tools {

/// The command that `words` name, as far as they do; `rest` becomes the index of the first word
/// that names none.
[[nodiscard]] const CLI::App& commandNamed(const CLI::App& program,
                                           const std::vector<std::string>& words,
                                           std::size_t& rest);

/// "avatar check: ": how an error about a command begins; nothing for the program itself.
[[nodiscard]] std::string leadOf(const CLI::App& app);

/// "unknown command 'replya'; did you mean 'replay'?"
[[nodiscard]] std::string unknownCommand(const CLI::App& app, const std::string& word);

/// `words`: those behind the program's name; `parsersWords`: what the parser says, for all
/// that is not a name or an argument too many.
[[nodiscard]] std::string usageError(const CLI::App& program, const std::vector<std::string>& words,
                                     const std::string& parsersWords);

/// The text, and where its command's help is.
[[nodiscard]] std::string withHelpOf(const CLI::App& app, const std::string& text);

}  // namespace foretouch::tools
