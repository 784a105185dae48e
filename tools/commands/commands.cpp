#include "tools/commands/commands.h"

#include <string>
#include <utility>

#include "tools/audit/avatar_command.h"
#include "tools/audit/scene_command.h"
#include "tools/commands/demo_command.h"
#include "tools/commands/replay_command.h"
#include "tools/commands/serve_command.h"
#include "tools/log/log_command.h"
#include "tools/report/view_command.h"
#include "tools/setup/setup_command.h"
#include "tools/stream/listen_command.h"
#include "tools/stream/publish_command.h"
#include "tools/sweep/sweep_command.h"

namespace foretouch::tools {
namespace {

/// The benchmarks moved to another program: tells users where.
Command movedCommand(const std::string& name, const std::string& now) {
  Command moved;
  moved.name = name;
  moved.isGone = "foretouch " + name + ": benchmarks are a program of their own, " + now;
  return moved;
}

void addCommands(CLI::App& program, ExitCode& exit) {
  for (const auto command :
       {demoCommand, setupCommand, replayCommand, viewCommand, serveCommand, publishCommand, listenCommand,
        avatarCommand, sceneCommand, sweepCommand, logCommand}) {
    addCommand(program, command(), exit);
  }
  addCommand(program, movedCommand("bench", "foretouch-bench"), exit);
  addCommand(program, movedCommand("tune", "foretouch-bench tune"), exit);
}

}  // namespace

int runForetouch(int argc, const char* const* argv) noexcept {
  return runProgram(
      {"foretouch", "Continuous collision detection of avatars: what they touch between two poses.",
       "Start with: foretouch demo"},
      addCommands, argc, argv);
}

}  // namespace foretouch::tools
