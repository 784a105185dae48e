#include "tools/commands/commands.h"

#include <string>

#include <CLI/CLI.hpp>

#include "tools/audit/avatar_command.h"
#include "tools/audit/scene_command.h"
#include "tools/commands/demo_command.h"
#include "tools/commands/replay_command.h"
#include "tools/commands/serve_command.h"
#include "tools/log/log_command.h"
#include "tools/report/view_command.h"
#include "tools/stream/listen_command.h"
#include "tools/stream/publish_command.h"
#include "tools/sweep/sweep_command.h"

namespace foretouch::tools {
namespace {

/// Benchmarks left this program: whoever still asks it for them is told where they are.
void addMovedCommand(CLI::App& program, const std::string& name, const std::string& now,
                     ExitCode& exit) {
  CLI::App* const moved = program.add_subcommand(name)->group("")->allow_extras();
  moved->set_help_flag();
  moved->callback([name, now, &exit] {
    printError("foretouch " + name + ": benchmarks are a program of their own, " + now);
    exit = ExitCode::BadInput;
  });
}

void addCommands(CLI::App& program, ExitCode& exit) {
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
  addMovedCommand(program, "bench", "foretouch-bench", exit);
  addMovedCommand(program, "tune", "foretouch-bench tune", exit);
}

}  // namespace

int runForetouch(int argc, const char* const* argv) noexcept {
  return runProgram(
      {"foretouch",
       "Continuous collision detection of avatars: what is touched between two poses.",
       "Start with: foretouch demo"},
      addCommands, argc, argv);
}

}  // namespace foretouch::tools
