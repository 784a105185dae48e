#include "tools/usage_error.h"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

#include "assets/near_names.h"
#include "assets/text_file.h"
#include "tools/help_page.h"

namespace foretouch::tools {
namespace {

bool isListed(const CLI::App& app) {
  return !app.get_group().empty();
}

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({})) {
    if (isListed(*command)) names.push_back(command->get_name());
  }
  return names;
}

/// The names of options as help lists them.
std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : app.get_options()) {
    if (option->get_group().empty() || option->get_lnames().empty()) continue;
    names.push_back("--" + option->get_lnames()[0]);
  }
  return names;
}

/// "--output" of "--output=x"; empty for what is not an option's name: a value, a number.
std::string optionIn(const std::string& word) {
  if (word.size() < 2 || word[0] != '-' || word == "--") return "";
  const auto second = static_cast<unsigned char>(word[1]);
  if (word[1] == '-') return word.substr(0, word.find('='));
  return std::isalpha(second) != 0 ? word.substr(0, 2) : "";
}

/// Near ones; where none is, those about the same thing: "--scene-scale" for "--scale".
std::string optionMeant(const CLI::App& app, const std::string& typed) {
  const std::vector<std::string> names = optionNames(app);
  const std::string near = didYouMean(typed, names);
  if (!near.empty()) return near;
  const std::string subject = typed.substr(typed.rfind('-') + 1);
  std::string alike;
  for (const std::string& name : names) {
    if (subject.size() < 2 || name.substr(name.rfind('-') + 1) != subject) continue;
    alike += (alike.empty() ? "; did you mean " : ", ") + inQuotes(name);
  }
  return alike.empty() ? alike : alike + "?";
}

std::string unknownOption(const CLI::App& app, const std::string& option) {
  return leadOf(app) + "unknown option " + inQuotes(option) + optionMeant(app, option);
}

/// The first word from `from` on that looks like an option and is not one.
std::string firstUnknownOption(const CLI::App& app, const std::vector<std::string>& words,
                               std::size_t from) {
  for (std::size_t i = from; i < words.size() && words[i] != "--"; ++i) {
    const std::string option = optionIn(words[i]);
    if (!option.empty() && app.get_option_no_throw(option) == nullptr) return option;
  }
  return "";
}

/// The first word, as typed, that the parser had no use for.
std::string firstOver(const CLI::App& app, const std::vector<std::string>& words,
                      std::size_t from) {
  const std::vector<std::string> over = app.remaining();
  for (std::size_t i = from; i < words.size(); ++i) {
    if (std::find(over.begin(), over.end(), words[i]) != over.end()) return words[i];
  }
  return "";
}

}  // namespace

std::string leadOf(const CLI::App& app) {
  const std::string words = wordsOf(app);
  const std::size_t blank = words.find(' ');
  return blank == std::string::npos ? "" : words.substr(blank + 1) + ": ";
}

const CLI::App& commandNamed(const CLI::App& program, const std::vector<std::string>& words,
                             std::size_t& rest) {
  const CLI::App* app = &program;
  for (rest = 0; rest < words.size(); ++rest) {
    const auto named = app->get_subcommands([&](const CLI::App* command) {
      return isListed(*command) && command->get_name() == words[rest];
    });
    if (named.empty()) break;
    app = named.front();
  }
  return *app;
}

std::string unknownCommand(const CLI::App& app, const std::string& word) {
  return leadOf(app) + "unknown command " + inQuotes(word) + didYouMean(word, commandNames(app));
}

std::string usageError(const CLI::App& program, const std::vector<std::string>& words,
                       const std::string& parsersWords) {
  std::size_t rest = 0;
  const CLI::App& app = commandNamed(program, words, rest);
  const std::string option = firstUnknownOption(app, words, rest);
  const bool hasCommands = !commandNames(app).empty();
  std::string text = leadOf(app);
  if (hasCommands && rest < words.size() && optionIn(words[rest]).empty()) {
    text = unknownCommand(app, words[rest]);
  } else if (!option.empty()) {
    text = unknownOption(app, option);
  } else if (hasCommands) {
    text += "expected a command:";
    for (const std::string& name : commandNames(app)) text += " " + name;
  } else if (const std::string over = firstOver(app, words, rest); !over.empty()) {
    text += "expected no argument " + inQuotes(over);
  } else {
    // "--scene: 1 required FILE missing"
    const std::size_t missing = parsersWords.find(": 1 required ");
    const bool isMissing = missing != std::string::npos;
    text += isMissing ? parsersWords.substr(0, missing) + ": expected a value" : parsersWords;
  }
  return withHelpOf(app, text);
}

std::string withHelpOf(const CLI::App& app, const std::string& text) {
  const bool isQuestion = !text.empty() && text.back() == '?';
  return text + (isQuestion ? " See " : "; see ") + wordsOf(app) + " --help";
}

}  // namespace foretouch::tools
