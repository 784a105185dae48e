#include "tools/program.h"

#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/audit/avatar_command.h"
#include "tools/audit/scene_command.h"
#include "tools/bench/command.h"
#include "tools/bench/tune_command.h"
#include "tools/commands/demo_command.h"
#include "tools/commands/replay_command.h"
#include "tools/commands/serve_command.h"
#include "tools/console.h"
#include "tools/log/log_command.h"
#include "tools/report/view_command.h"
#include "tools/stream/listen_command.h"
#include "tools/stream/publish_command.h"
#include "tools/sweep/sweep_command.h"

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

ExitCode run(int argc, const char* const* argv) {
  CLI::App program("Continuous collision detection of avatars: what is touched between two poses.",
                   "foretouch");
  program.set_version_flag("--version", "foretouch " FORETOUCH_VERSION);
  program.require_subcommand(1);
  program.footer("Start with: foretouch demo");
  ExitCode exit = ExitCode::Done;
  addDemoCommand(program, exit);
  addReplayCommand(program, exit);
  addViewCommand(program, exit);
  addServeCommand(program, exit);
  addPublishCommand(program, exit);
  addListenCommand(program, exit);
  addAvatarCommand(program, exit);
  addSceneCommand(program, exit);
  addSweepCommand(program, exit);
  addLogCommand(program, exit);
  addTuneCommand(program, exit);
  addBenchCommand(program, exit);
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

int runProgram(int argc, const char* const* argv) noexcept {
  ExitCode exit = ExitCode::BadInput;
  try {
    exit = run(argc, argv);
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
