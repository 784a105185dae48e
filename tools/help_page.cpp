#include "tools/help_page.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>

#include "tools/console.h"

namespace foretouch::tools {
namespace {

bool isGeneral(const CLI::App& app, const CLI::Option& option) {
  return &option == app.get_help_ptr() || &option == app.get_help_all_ptr() ||
         &option == app.get_version_ptr() || option.get_group() == kGeneralGroup;
}

/// The short name and the first long one: those after it are former ones.
std::string namesOf(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true, false);
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ",-") + name;
  if (!option.get_lnames().empty())
    names += (names.empty() ? "--" : ",--") + option.get_lnames()[0];
  return names;
}

HelpOption entryOf(const CLI::Option& option) {
  HelpOption entry;
  entry.names = namesOf(option);
  entry.text = option.get_description();
  entry.isArgument = option.get_positional();
  entry.isRequired = option.get_required() || option.get_option_text() == kRequired;
  for (const CLI::Option* const other : option.get_needs()) {
    entry.text += "; needs " + namesOf(*other);
  }
  if (option.get_type_size() == 0) return entry;
  entry.value = option.get_type_name();
  if (!option.get_default_str().empty()) {
    entry.defaultText =
        (option.get_expected_min() == 0 ? "without a value: " : "") + option.get_default_str();
  }
  return entry;
}

HelpGroup& groupOf(std::vector<HelpGroup>& groups, const std::string& title) {
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const HelpGroup& group) { return group.title == title; });
  return found != groups.end() ? *found : groups.emplace_back(HelpGroup{title, {}});
}

void addOptions(const CLI::App& app, HelpPage& page) {
  HelpGroup arguments{"Arguments", {}}, general{kGeneralGroup, {}};
  std::vector<HelpGroup> others;
  for (const CLI::Option* const option : app.get_options()) {
    if (option->get_group().empty()) continue;
    if (option->get_positional()) {
      arguments.entries.push_back(entryOf(*option));
    } else if (isGeneral(app, *option)) {
      general.entries.push_back(entryOf(*option));
    } else {
      groupOf(others, option->get_group()).entries.push_back(entryOf(*option));
    }
  }
  if (!arguments.entries.empty()) page.groups.push_back(std::move(arguments));
  for (HelpGroup& group : others) page.groups.push_back(std::move(group));
  if (!general.entries.empty()) page.groups.push_back(std::move(general));
}

HelpGroup exitCodes() {
  HelpGroup group{"Exit codes", {}};
  for (const ExitMeaning& meaning : kExitMeanings) {
    HelpOption entry;
    entry.names = std::to_string(static_cast<int>(meaning.code));
    entry.text = meaning.text;
    group.entries.push_back(entry);
  }
  return group;
}

std::vector<HelpBlock> blocksOf(const std::string& footer) {
  std::istringstream lines(footer);
  std::vector<HelpBlock> blocks;
  HelpBlock block;
  const auto end = [&] {
    if (!block.text.empty()) blocks.push_back(std::exchange(block, {}));
  };
  for (std::string line; std::getline(lines, line);) {
    const bool goesOn = !line.empty() && line.back() == '\\';
    const bool isCommand = line.rfind("  ", 0) == 0;
    if (line.empty() || line.back() == ':' || isCommand != block.isCommand) end();
    block.isCommand = isCommand;
    const std::size_t from = std::min(line.find_first_not_of(' '), line.size());
    if (!block.text.empty() && block.text.back() != ' ') block.text += " ";
    block.text += line.substr(from, line.size() - from - (goesOn ? 1 : 0));
    if (isCommand && !goesOn) end();
  }
  end();
  return blocks;
}

/// Comes before the options: users who ask for a program's help look for a command.
void addCommandEntries(const CLI::App& app, HelpPage& page) {
  std::vector<HelpGroup> groups;
  for (const CLI::App* const command : app.get_subcommands({})) {
    if (command->get_group().empty()) continue;
    const bool isPlain = command->get_group() == "Subcommands";
    HelpOption entry;
    entry.names = command->get_name();
    entry.text = command->get_description();
    groupOf(groups, isPlain ? "Commands" : command->get_group()).entries.push_back(entry);
  }
  page.groups.insert(page.groups.begin(), groups.begin(), groups.end());
}

std::string usageOf(const CLI::App& app, const HelpPage& page) {
  std::string usage = page.command;
  if (!app.get_subcommands({}).empty()) usage += " COMMAND";
  std::string required, arguments;
  for (const HelpGroup& group : page.groups) {
    for (const HelpOption& entry : group.entries) {
      if (entry.isArgument) {
        const std::string name = entry.value.empty() ? entry.names : entry.value;
        arguments += entry.isRequired ? " " + name : " [" + name + "]";
      } else if (entry.isRequired) {
        required += " " + entry.names.substr(entry.names.rfind(',') + 1) + " " + entry.value;
      }
    }
  }
  return usage + arguments + required + " [OPTIONS]";
}

}  // namespace

std::string wordsOf(const CLI::App& app) {
  std::string words;
  for (const CLI::App* a = &app; a != nullptr; a = a->get_parent()) {
    words = a->get_name() + (words.empty() ? "" : " ") + words;
  }
  return words;
}

HelpPage helpPageOf(const CLI::App& app) {
  HelpPage page;
  page.command = wordsOf(app);
  page.purpose = app.get_description();
  addOptions(app, page);
  page.usage = usageOf(app, page);
  addCommandEntries(app, page);
  if (app.get_parent() == nullptr) page.groups.push_back(exitCodes());
  page.footer = blocksOf(app.get_footer());
  return page;
}

std::vector<const CLI::App*> listedCommands(const CLI::App& app) {
  std::vector<const CLI::App*> listed;
  for (const CLI::App* const command : app.get_subcommands({})) {
    if (command->get_group().empty()) continue;
    listed.push_back(command);
    for (const CLI::App* const inner : listedCommands(*command)) listed.push_back(inner);
  }
  return listed;
}

}  // namespace foretouch::tools
