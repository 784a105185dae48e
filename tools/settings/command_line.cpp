#include "tools/settings/command_line.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "tools/help_page.h"
#include "tools/settings/project_file.h"
#include "tools/usage_error.h"

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
  std::string project;  ///< The value of --project.
  const CLI::App* app = nullptr;
  std::deque<Typed> typed;
  bool isQuiet = false;
};

/// The option's names, with the former ones behind it, which help leaves out.
std::string namesOf(const Setting& setting) {
  std::string names = setting.option;
  for (const std::string& former : setting.formerNames) names += "," + former;
  return names;
}

/// Help shows no default if there is none.
void addOption(CLI::App& app, Typed& typed) {
  const Setting& setting = *typed.setting;
  const std::string names = namesOf(setting);
  if (setting.kind == ValueKind::Flag) {
    typed.option = app.add_flag(names, setting.help);
    return;
  }
  if (setting.kind == ValueKind::List) {
    typed.option = app.add_option(names, typed.texts, setting.help);
    if (setting.option.front() == '-') typed.option->allow_extra_args(false);
  } else {
    typed.text = setting.shown();
    typed.option = app.add_option(names, typed.text, setting.help);
    if (!typed.text.empty()) typed.option->capture_default_str();
  }
  typed.option->type_name(setting.value);
}

void addSetting(CLI::App& app, Typed& typed) {
  const Setting& setting = *typed.setting;
  addOption(app, typed);
  if (!setting.group.empty()) typed.option->group(setting.group);
  if (setting.isRequired && !setting.isFilledByFiles) typed.option->option_text(kRequired);
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

/// The project to take settings from; empty: none. One that lies in the current folder counts only
/// where the command line names no files: it never mixes with others by accident.
std::string projectOf(const Subcommand& subcommand) {
  if (!subcommand.command.takesProject) return "";
  bool namesFiles = false;
  for (const Typed& typed : subcommand.typed) {
    if (typed.option->count() == 0) continue;
    if (typed.setting->option == "--project") return typed.text;
    const bool isPositional = typed.setting->option.front() != '-';
    namesFiles = namesFiles || isPositional || typed.setting->key == "file";
  }
  std::error_code unused;
  return !namesFiles && std::filesystem::is_regular_file(kProjectName, unused) ? kProjectName : "";
}

Result<Done> takeProject(Subcommand& subcommand) {
  const std::string path = projectOf(subcommand);
  if (path.empty()) return Done{};
  FORETOUCH_TRY(const auto notes,
                takeFromProject(path, subcommand.command.settings,
                                [](const Setting& setting) { return setting.isGiven; }));
  printNote("settings from " + path);
  for (const std::string& note : notes) printNote(note);
  return Done{};
}

/// "--scene and --output are required" or "expected a scene file"; empty: nothing is missing.
std::string missingIn(const Subcommand& subcommand) {
  const auto stands = [](const Typed& typed) {
    return typed.setting->standsForRequired && typed.setting->isGiven;
  };
  if (std::any_of(subcommand.typed.begin(), subcommand.typed.end(), stands)) return "";
  std::vector<std::string> names;
  for (const Typed& typed : subcommand.typed) {
    const Setting& setting = *typed.setting;
    if (!setting.isRequired || setting.isGiven || !setting.shown().empty()) continue;
    if (!setting.noun.empty()) return "expected " + setting.noun;
    names.push_back(setting.name());
  }
  if (names.empty()) return "";
  return wordList(names, "and") + (names.size() == 1 ? " is required" : " are required");
}

ExitCode runSubcommand(Subcommand& subcommand) {
  if (subcommand.isQuiet) keepQuiet();
  for (const Typed& typed : subcommand.typed) {
    typed.setting->isGiven = typed.option->count() > 0;
  }
  // A project does not say what files without an option are.
  for (const Typed& typed : subcommand.typed) {
    if (typed.setting->fillsOthers) FORETOUCH_CHECK_OR(failed, take(typed));
  }
  FORETOUCH_CHECK_OR(failed, takeProject(subcommand));
  for (const Typed& typed : subcommand.typed) {
    if (!typed.setting->fillsOthers) FORETOUCH_CHECK_OR(failed, take(typed));
  }
  if (const std::string missing = missingIn(subcommand); !missing.empty()) {
    printError(withHelpOf(*subcommand.app, leadOf(*subcommand.app) + missing));
    return ExitCode::BadInput;
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
  if (!command.group.empty()) app->group(command.group);
  if (!command.commands.empty()) {
    app->require_subcommand(1);
    for (Command& inner : command.commands) addCommand(*app, std::move(inner), exit);
    return;
  }
  const auto subcommand = std::make_shared<Subcommand>();
  subcommand->command = std::move(command);
  if (subcommand->command.takesProject) {
    addProjectSetting(subcommand->command.settings, subcommand->project);
  }
  subcommand->app = app;
  for (Setting& setting : subcommand->command.settings) {
    Typed& typed = subcommand->typed.emplace_back();
    typed.setting = &setting;
    addSetting(*app, typed);
  }
  app->add_flag("-q,--quiet", subcommand->isQuiet, "No notes and no progress")
      ->group(kGeneralGroup);
  app->callback([subcommand, &exit] { exit = runSubcommand(*subcommand); });
}

}  // namespace foretouch::tools
