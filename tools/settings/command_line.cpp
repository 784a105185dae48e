#include "tools/settings/command_line.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "articulated/try.h"

namespace foretouch::tools {
namespace {

/// A setting, and its text on the command line.
struct Typed {
  Setting* setting = nullptr;
  CLI::Option* option = nullptr;
  std::string text;
  std::vector<std::string> texts;
};

/// A command's data after parsing.
struct Subcommand {
  Command command;
  std::deque<Typed> typed;
};

/// Help shows no default if there is none.
void addSetting(CLI::App& app, Typed& typed) {
  const Setting& setting = *typed.setting;
  if (setting.kind == ValueKind::Flag) {
    typed.option = app.add_flag(setting.option, setting.help);
    return;
  }
  if (setting.kind == ValueKind::List) {
    typed.option = app.add_option(setting.option, typed.texts, setting.help);
    if (setting.option.front() == '-') typed.option->allow_extra_args(false);
  } else {
    typed.text = setting.shown();
    typed.option = app.add_option(setting.option, typed.text, setting.help);
    if (!typed.text.empty()) typed.option->capture_default_str();
  }
  typed.option->type_name(setting.value);
  if (setting.isRequired) typed.option->required();
  if (!setting.needs.empty()) typed.option->needs(app.get_option(setting.needs));
  if (!setting.isGone.empty()) typed.option->group("");  // hidden from help
  if (!setting.valueIfNone.empty()) {
    typed.option->expected(0, 1)->default_str(setting.valueIfNone);
  }
}

Result<Done> take(const Typed& typed) {
  if (typed.option->count() == 0) return Done{};
  switch (typed.setting->kind) {
    case ValueKind::Flag: return takeTyped(*typed.setting, {});
    case ValueKind::List: return takeTyped(*typed.setting, typed.texts);
    default: return takeTyped(*typed.setting, {typed.text});
  }
}

ExitCode runSubcommand(const Subcommand& subcommand) {
  for (const Typed& typed : subcommand.typed) {
    FORETOUCH_CHECK_OR(failed, take(typed));
  }
  return subcommand.command.run(subcommand.command.settings);
}

/// Hidden from help: only users who still name it see the text.
void addGone(CLI::App& program, const Command& command, ExitCode& exit) {
  CLI::App* const gone = program.add_subcommand(command.name)->group("")->allow_extras();
  gone->set_help_flag();
  gone->callback([text = command.isGone, &exit] {
    printError(text);
    exit = ExitCode::BadInput;
  });
}

}  // namespace

void addCommand(CLI::App& program, Command command, ExitCode& exit) {
  if (!command.isGone.empty()) return addGone(program, command, exit);
  CLI::App* const app = program.add_subcommand(command.name, command.purpose);
  if (!command.examples.empty()) app->footer(command.examples);
  if (!command.commands.empty()) {
    app->require_subcommand(1);
    for (Command& inner : command.commands) addCommand(*app, std::move(inner), exit);
    return;
  }
  const auto subcommand = std::make_shared<Subcommand>();
  subcommand->command = std::move(command);
  for (Setting& setting : subcommand->command.settings) {
    Typed& typed = subcommand->typed.emplace_back();
    typed.setting = &setting;
    addSetting(*app, typed);
  }
  app->callback([subcommand, &exit] { exit = runSubcommand(*subcommand); });
}

}  // namespace foretouch::tools
