#include "tools/commands/completion.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "tools/settings/project_file.h"

namespace foretouch::tools {
namespace {

using Commands = std::vector<CompletableCommand>;

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

std::vector<std::string> split(const std::string& text, char between) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, between);) parts.push_back(part);
  return parts;
}

/// The text in single quotes, for all three shells.
std::string shellQuoted(const std::string& text, const char* quote) {
  std::string told = "'";
  for (const char c : text) told += c == '\'' ? std::string(quote) : std::string(1, c);
  return told + "'";
}
std::string shellQuoted(const std::string& text) {
  return shellQuoted(text, "'\\''");
}

Completable completable(const Setting& setting) {
  Completable option;
  const bool isArgument = setting.option.front() != '-';
  if (!isArgument) option.names = split(setting.option, ',');
  option.help = setting.help;
  option.takesValue = setting.kind != ValueKind::Flag;
  if (option.takesValue) option.words = setting.words;
  option.takesFiles = setting.takesFiles;
  option.endings = setting.endings;
  return option;
}

const std::vector<Completable>& general() {
  static const std::vector<Completable> options = {
      {{"-h", "--help"}, "Show this help", {}, "", false, false},
      {{"-q", "--quiet"}, "No notes and no progress", {}, "", false, false}};
  return options;
}

void add(const Command& command, std::vector<std::string> path, Commands& commands) {
  if (!command.isGone.empty()) return;
  path.push_back(command.name);
  CompletableCommand& told = commands.emplace_back();
  told.path = path;
  told.purpose = command.purpose;
  for (const Setting& setting : command.settings) {
    if (!setting.isGone.empty()) continue;
    (setting.option.front() == '-' ? told.options : told.arguments).push_back(completable(setting));
  }
  if (command.takesProject) {
    Settings added;
    std::string project;
    told.options.push_back(completable(addProjectSetting(added, project)));
  }
  told.options.insert(told.options.end(), general().begin(), general().end());
  for (const Command& inner : command.commands) add(inner, path, commands);
}

/// The commands right below one.
std::vector<const CompletableCommand*> below(const CompletableCommand& command,
                                             const Commands& commands) {
  std::vector<const CompletableCommand*> found;
  for (const CompletableCommand& other : commands) {
    if (other.path.size() == command.path.size() + 1 &&
        std::equal(command.path.begin(), command.path.end(), other.path.begin())) {
      found.push_back(&other);
    }
  }
  return found;
}

/// "/avatar/check"; nothing for the program.
std::string placeOf(const CompletableCommand& command) {
  return (command.path.empty() ? "" : "/") + joined(command.path, "/");
}

/// The words before the cursor that are commands, in bash and zsh. Variables: `at` and `i`.
std::string pathCase(const Commands& commands) {
  std::vector<std::string> places;
  for (const CompletableCommand& command : commands) {
    if (!command.path.empty()) places.push_back(placeOf(command));
  }
  return joined(places, "|");
}

std::string bashValue(const Completable& option) {
  if (option.takesFiles) return "_foretouch_files " + option.endings;
  if (option.words.empty()) return ":";
  return "COMPREPLY=($(compgen -W " + shellQuoted(joined(option.words, " ")) + " -- \"$cur\"))";
}

std::string zshValue(const Completable& option) {
  if (option.takesFiles) {
    if (option.endings.empty()) return "_files";
    return "_files -g '(#i)*.(" + joined(split(option.endings, ' '), "|") + ")(-.)'";
  }
  return option.words.empty() ? ":" : "compadd -- " + joined(option.words, " ");
}

/// case "$at:$prev": what may stand behind an option.
template <typename ValueOf>
std::string valueCases(const Commands& commands, const ValueOf& valueOf) {
  std::string text;
  for (const CompletableCommand& command : commands) {
    for (const Completable& option : command.options) {
      if (!option.takesValue) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names)
        patterns.push_back(placeOf(command) + ":" + name);
      text += "    (" + joined(patterns, "|") + ") " + valueOf(option) + "; return ;;\n";
    }
  }
  return text;
}

constexpr char kBashFrame[] = R"(# bash completion of foretouch. Made by: foretouch completion bash

_foretouch_files() {{
  local file ending
  compopt -o filenames 2>/dev/null
  while IFS= read -r file; do
    if [ -d "$file" ] || [ $# -eq 0 ]; then COMPREPLY+=("$file"); continue; fi
    for ending in "$@"; do
      case "${{file,,}}" in *".$ending") COMPREPLY+=("$file"); break ;; esac
    done
  done < <(compgen -f -- "$cur")
}}

_foretouch() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} at='' i
  local commands='' options='' argument=':'
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$at/${{COMP_WORDS[i]}}" in
      ({0}) at+="/${{COMP_WORDS[i]}}" ;;
      (*) break ;;
    esac
  done
  case "$at:$prev" in
{1}  esac
  case "$at" in
{2}  esac
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
  elif [ -n "$commands" ]; then
    COMPREPLY=($(compgen -W "$commands" -- "$cur"))
  else
    eval "$argument"
  fi
}}

complete -F _foretouch foretouch
)";

std::string bashScript(const Commands& commands) {
  std::string cases;
  for (const CompletableCommand& command : commands) {
    std::string words, names;
    for (const CompletableCommand* const inner : below(command, commands)) {
      words += (words.empty() ? "" : " ") + inner->path.back();
    }
    for (const Completable& option : command.options) {
      names += (names.empty() ? "" : " ") + joined(option.names, " ");
    }
    cases += fmt::format("    ({}) commands={} options={}", shellQuoted(placeOf(command)),
                         shellQuoted(words), shellQuoted(names));
    if (!command.arguments.empty()) {
      cases += " argument=" + shellQuoted(bashValue(command.arguments.front()));
    }
    cases += " ;;\n";
  }
  return fmt::format(kBashFrame, pathCase(commands), valueCases(commands, bashValue), cases);
}

/// 'name:what it is' for zsh's _describe.
std::string described(const std::string& name, const std::string& help) {
  return shellQuoted(name + ":" + help);
}

constexpr char kZshFrame[] = R"(#compdef foretouch
# zsh completion of foretouch. Made by: foretouch completion zsh

_foretouch() {{
  setopt local_options extended_glob
  local cur=${{words[CURRENT]}} prev=${{words[CURRENT-1]}} at='' i argument=':'
  local -a commands options
  for ((i = 2; i < CURRENT; i++)); do
    case "$at/${{words[i]}}" in
      ({0}) at+="/${{words[i]}}" ;;
      (*) break ;;
    esac
  done
  case "$at:$prev" in
{1}  esac
  case "$at" in
{2}  esac
  if [[ $cur == -* ]]; then
    _describe -o option options
  elif (( $#commands )); then
    _describe command commands
  else
    eval "$argument"
  fi
}}

if [ "$funcstack[1]" = _foretouch ]; then _foretouch "$@"; else compdef _foretouch foretouch; fi
)";

std::string zshScript(const Commands& commands) {
  std::string cases;
  for (const CompletableCommand& command : commands) {
    std::string words, names;
    for (const CompletableCommand* const inner : below(command, commands)) {
      words += " " + described(inner->path.back(), inner->purpose);
    }
    for (const Completable& option : command.options) {
      for (const std::string& name : option.names) names += " " + described(name, option.help);
    }
    cases += fmt::format("    ({}) commands=({}) options=({})", shellQuoted(placeOf(command)),
                         words, names);
    if (!command.arguments.empty()) {
      cases += " argument=" + shellQuoted(zshValue(command.arguments.front()));
    }
    cases += " ;;\n";
  }
  return fmt::format(kZshFrame, pathCase(commands), valueCases(commands, zshValue), cases);
}

std::string fishQuoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '\\' ? std::string("\\\\") : std::string(1, c);
  return shellQuoted(escaped, "\\'");
}

std::string fishValue(const Completable& option) {
  if (option.takesFiles && option.endings.empty()) return " -r -F";
  if (option.takesFiles) return " -x -a '(__foretouch_files " + option.endings + ")'";
  return option.words.empty() ? " -x" : " -x -a " + fishQuoted(joined(option.words, " "));
}

std::string fishOption(const std::string& condition, const Completable& option) {
  std::string text = "complete -c foretouch -n " + fishQuoted(condition);
  for (const std::string& name : option.names) {
    text += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (option.takesValue && !option.names.empty()) text += fishValue(option);
  if (option.names.empty() && option.takesFiles) text += fishValue(option);
  if (option.names.empty() && !option.words.empty()) {
    text += " -a " + fishQuoted(joined(option.words, " "));
  }
  return text + " -d " + fishQuoted(option.help) + "\n";
}

constexpr char kFishFrame[] = R"(# fish completion of foretouch. Made by: foretouch completion fish

# Whether the command line begins with these words.
function __foretouch_at
    set -l words (commandline -opc)
    set -e words[1]
    for word in $argv
        test "$words[1]" = "$word"; or return 1
        set -e words[1]
    end
end

# Whether nothing follows them.
function __foretouch_ends
    __foretouch_at $argv; and test (count (commandline -opc)) -eq (math (count $argv) + 1)
end

function __foretouch_files
    for file in (commandline -ct)*
        if test -d $file
            echo $file/
        else if string match -qri '\.('(string join '|' $argv)')$' -- $file
            echo $file
        end
    end
end

complete -c foretouch -f
)";

std::string fishScript(const Commands& commands) {
  std::string text = kFishFrame;
  for (const CompletableCommand& command : commands) {
    const std::string words = joined(command.path, " ");
    for (const CompletableCommand* const inner : below(command, commands)) {
      text += "complete -c foretouch -n " + fishQuoted("__foretouch_ends " + words) + " -a " +
              inner->path.back() + " -d " + fishQuoted(inner->purpose) + "\n";
    }
    for (const Completable& option : command.options) {
      text += fishOption("__foretouch_at " + words, option);
    }
    for (const Completable& argument : command.arguments) {
      text += fishOption("__foretouch_at " + words, argument);
    }
  }
  return text;
}

}  // namespace

std::vector<CompletableCommand> completableCommands(const std::vector<Command>& commands) {
  Commands told(1);
  told.front().options = {{{"-h", "--help"}, "Show this help", {}, "", false, false},
                          {{"--help-all"}, "Show the help of every command", {}, "", false, false},
                          {{"-V", "--version"}, "Show the version", {}, "", false, false}};
  for (const Command& command : commands) add(command, {}, told);
  std::vector<std::string> names;
  for (const CompletableCommand* const command : below(told.front(), told)) {
    names.push_back(command->path.back());
  }
  for (const auto& [name, purpose] : {std::pair("help", "Show the help of a command"),
                                      std::pair("man", "Print a command's manual page"),
                                      std::pair("version", "Show the version")}) {
    CompletableCommand& own = told.emplace_back();
    own.path = {name};
    own.purpose = purpose;
    own.options = {general().front()};
    if (own.path.front() != "version") own.arguments = {{{}, "Command", names, "", true, false}};
  }
  return told;
}

std::string completionScript(Shell shell, const std::vector<CompletableCommand>& commands) {
  switch (shell) {
    case Shell::Bash: return bashScript(commands);
    case Shell::Zsh: return zshScript(commands);
    case Shell::Fish: return fishScript(commands);
  }
  return "";
}

}  // namespace foretouch::tools
