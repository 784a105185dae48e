#include "tools/commands/commands.h"

#include <string>
#include <utility>
#include <vector>

#include "tools/ask/ask_command.h"
#include "tools/audit/avatar_command.h"
#include "tools/audit/scene_command.h"
#include "tools/batch/batch_command.h"
#include "tools/certificate/certify_command.h"
#include "tools/colliders/avatar_colliders_command.h"
#include "tools/commands/completion_command.h"
#include "tools/commands/demo_command.h"
#include "tools/commands/log_replay_command.h"
#include "tools/commands/replay_command.h"
#include "tools/commands/serve_command.h"
#include "tools/commands/world_command.h"
#include "tools/feet/feet_command.h"
#include "tools/help_page.h"
#include "tools/log/log_command.h"
#include "tools/person/bounds_command.h"
#include "tools/repair/repair_command.h"
#include "tools/report/view_command.h"
#include "tools/setup/setup_command.h"
#include "tools/solid/solid_command.h"
#include "tools/stream/listen_command.h"
#include "tools/stream/publish_command.h"
#include "tools/sweep/sweep_command.h"

namespace foretouch::tools {
namespace {

/// The benchmarks moved to another program: shows users where.
Command movedCommand(const std::string& name, const std::string& now) {
  Command moved;
  moved.name = name;
  moved.isGone = "foretouch " + name + ": benchmarks are a program of their own, " + now;
  return moved;
}

/// All of the program's commands, as help lists them.
std::vector<Command> allCommands() {
  std::vector<Command> commands;
  const auto add = [&](const char* group, Command command) {
    command.group = group;
    commands.push_back(std::move(command));
  };
  add("Start here", demoCommand());
  add("Start here", setupCommand());
  add("Start here", viewCommand());
  add("Ask", replayCommand());
  add("Ask", feetCommand());
  add("Ask", repairCommand());
  add("Ask", batchCommand(replayCommand, feetCommand));
  add("Ask", worldCommand());
  add("Ask", askCommand());
  add("Ask", sweepCommand());
  add("Ask", certifyCommand());
  add("Live", serveCommand());
  add("Live", publishCommand());
  add("Live", listenCommand());
  Command avatar = avatarCommand();
  avatar.commands.push_back(avatarCollidersCommand());
  add("Files", std::move(avatar));
  add("Files", sceneCommand());
  add("Files", boundsCommand());
  Command log = logCommand();
  log.commands.push_back(logReplayCommand());
  add("Files", std::move(log));
  add("Files", solidCommand());
  add(kHelpGroup, completionCommand(allCommands));
  commands.push_back(movedCommand("bench", "foretouch-bench"));
  commands.push_back(movedCommand("tune", "foretouch-bench tune"));
  return commands;
}

void addCommands(CLI::App& program, ExitCode& exit) {
  for (Command& command : allCommands()) addCommand(program, std::move(command), exit);
}

}  // namespace

int runForetouch(int argc, const char* const* argv) noexcept {
  return runProgram(
      {"foretouch", "Continuous collision detection of avatars: what they touch between two poses.",
       "Start with: foretouch demo"},
      addCommands, argc, argv);
}

}  // namespace foretouch::tools
