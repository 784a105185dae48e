#include "tools/program.h"

#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/console.h"

namespace foretouch::tools {
namespace {

/// The innermost subcommand that the user named, for its help.
const CLI::App& innermost(const CLI::App& program) {
  const CLI::App* app = &program;
  for (auto named = app->get_subcommands(); !named.empty(); named = app->get_subcommands()) {
    app = named.front();
  }
  return *app;
}

std::string helpOf(const CLI::App& app) {
  std::string words;
  for (const CLI::App* a = &app; a != nullptr; a = a->get_parent()) {
    words = a->get_name() + (words.empty() ? "" : " ") + words;
  }
  return words + " --help";
}

ExitCode run(const ProgramText& text, const AddCommands& addCommands, int argc,
             const char* const* argv) {
  CLI::App program(text.purpose, text.name);
  program.set_version_flag("--version", std::string(text.name) + " " FORETOUCH_VERSION);
  program.require_subcommand(1);
  program.footer(text.start);
  ExitCode exit = ExitCode::Done;
  addCommands(program, exit);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success)) {
      printError(std::string(e.what()) + "; see " + helpOf(innermost(program)));
      return ExitCode::BadInput;
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
