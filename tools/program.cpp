#include "tools/program.h"

#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/console.h"
#include "tools/help_page.h"
#include "tools/help_text.h"
#include "tools/man_page.h"
#include "tools/usage_error.h"

namespace foretouch::tools {
namespace {

/// Shown by CLI11 wherever it shows help.
std::string helpOf(const CLI::App* app, const std::string&, CLI::AppFormatMode mode) {
  const std::size_t columns = textColumns();
  std::string text = helpText(helpPageOf(*app), columns);
  if (mode != CLI::AppFormatMode::All) return text;
  for (const CLI::App* const command : listedCommands(*app)) {
    text += "\n\n" + helpText(helpPageOf(*command), columns);
  }
  return text;
}

/// Prints what `about` says of the command that the words name.
ExitCode tell(const CLI::App& program, const std::vector<std::string>& words,
              const std::function<std::string(const CLI::App&)>& about) {
  std::size_t rest = 0;
  const CLI::App& app = commandNamed(program, words, rest);
  if (rest < words.size()) {
    printError(withHelpOf(app, unknownCommand(app, words[rest])));
    return ExitCode::BadInput;
  }
  printOut(about(app));
  return ExitCode::Done;
}

/// The manual page of one command; it refers to the program's, which refers to all.
std::string manPageOf(const CLI::App& program, const CLI::App& app, const std::string& version) {
  std::vector<std::string> others;
  if (&app != &program) others.push_back(wordsOf(program));
  for (const CLI::App* const other : listedCommands(app)) others.push_back(wordsOf(*other));
  return manPage(helpPageOf(app), version, others);
}

/// Writes the pages into `folder`, for an installation.
ExitCode writeManPages(const CLI::App& program, const std::string& version,
                       const std::string& folder) {
  std::vector<const CLI::App*> all = listedCommands(program);
  all.insert(all.begin(), &program);
  for (const CLI::App* const app : all) {
    FORETOUCH_TRY_OR(failed, auto file,
                     PendingFile::create(folder + "/" + manName(wordsOf(*app)) + ".1"));
    file.write(manPageOf(program, *app, version));
    FORETOUCH_CHECK_OR(failed, file.commit());
  }
  return ExitCode::Done;
}

/// A command about the program's commands.
CLI::App* addHelpCommand(CLI::App& program, const char* name, const char* purpose,
                         std::vector<std::string>& words) {
  CLI::App* const own = program.add_subcommand(name, purpose);
  own->group(kHelpGroup);
  own->add_option("COMMAND", words, "The command's words; none: the program itself");
  return own;
}

void addManCommand(CLI::App& program, const std::string& version, ExitCode& exit) {
  const auto words = std::make_shared<std::vector<std::string>>();
  const auto folder = std::make_shared<std::string>();
  CLI::App* const man = addHelpCommand(program, "man", "Print a command's manual page", *words);
  man->footer("Example:\n  " + program.get_name() + " man | man -l -");
  man->add_option("--folder", *folder, "Write the pages of all commands into this folder")
      ->type_name("DIR");
  man->callback([&program, words, folder, version, &exit] {
    const auto page = [&](const CLI::App& app) { return manPageOf(program, app, version); };
    exit = folder->empty() ? tell(program, *words, page) : writeManPages(program, version, *folder);
  });
}

/// What every program has.
void addOwnCommands(CLI::App& program, const std::string& version, ExitCode& exit) {
  const auto words = std::make_shared<std::vector<std::string>>();
  addHelpCommand(program, "help", "Show the help of a command", *words)
      ->callback([&program, words, &exit] {
        exit = tell(program, *words, [](const CLI::App& app) {
          return helpOf(&app, "", CLI::AppFormatMode::Normal);
        });
      });
  addManCommand(program, version, exit);
  program.add_subcommand("version", "Show the version")->group(kHelpGroup)->callback([version] {
    printOut(version + "\n");
  });
}

/// Reports a command line that names no command: also `foretouch`, and `foretouch avatar help`.
ExitCode tellUsage(const CLI::App& program, const std::vector<std::string>& words,
                   const std::string& parsersWords) {
  std::size_t rest = 0;
  const CLI::App& app = commandNamed(program, words, rest);
  if (words.empty() || (rest + 1 == words.size() && words[rest] == "help")) {
    printOut(helpOf(&app, "", CLI::AppFormatMode::Normal));
    return words.empty() ? ExitCode::BadInput : ExitCode::Done;
  }
  printError(usageError(program, words, parsersWords));
  return ExitCode::BadInput;
}

ExitCode run(const ProgramText& text, const AddCommands& addCommands, int argc,
             const char* const* argv) {
  const std::string version = std::string(text.name) + " " FORETOUCH_VERSION;
  CLI::App program(text.purpose, text.name);
  program.formatter_fn(helpOf);
  program.set_help_flag("-h,--help", "Show this help");
  program.set_version_flag("-V,--version", version, "Show the version");
  program.require_subcommand(1);
  program.footer(text.start);
  ExitCode exit = ExitCode::Done;
  addCommands(program, exit);
  addOwnCommands(program, version, exit);
  // For the program alone: commands take over what is set before them.
  program.set_help_all_flag("--help-all", "Show the help of every command");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success)) {
      return tellUsage(program, {argv + 1, argv + argc}, e.what());
    }
    static_cast<void>(program.exit(e));  // prints the help or the version
  }
  return exit;
}

}  // namespace

int runProgram(const ProgramText& text, const AddCommands& addCommands, int argc,
               const char* const* argv) noexcept {
  ExitCode exit = ExitCode::BadInput;
  try {
    exit = run(text, addCommands, argc, argv);
  } catch (const std::bad_alloc&) {
    printError("ran out of memory");
  } catch (const std::exception& e) {
    printError(std::string("stopped unexpectedly: ") + e.what());
  }
  if (!outputArrived()) {
    printError("standard output: cannot be written");
    exit = ExitCode::BadInput;
  }
  return static_cast<int>(exit);
}

}  // namespace foretouch::tools
