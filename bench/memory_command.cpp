#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/memory.h"
#include "tools/inputs/policy_rules.h"
#include "tools/settings/command_line.h"
#include "tools/settings/words.h"

namespace foretouch::tools {
namespace {

ExitCode run(MemoryRequest request) {
  FORETOUCH_CHECK_OR(failed, readPolicies(request));
  FORETOUCH_TRY_OR(failed, const auto bench, measureMemory(request));
  printOut(memoryTable(bench));
  return ExitCode::Done;
}

}  // namespace

Command memoryCommand() {
  const auto request = std::make_shared<MemoryRequest>();
  Settings settings;
  addSceneSettings(settings, *request);
  settings.of("--scene").required();
  settings.path("--avatar", "FILE", request->avatarPath, "Avatar file (see foretouch avatar)")
      .required();
  settings
      .word("--fidelity", "link|exact", request->query.fidelity, fidelityWords(),
            "What touches, where no policy says more")
      .only({"link", "exact"});
  settings.path("--policy", "FILE", request->policyPath, "As of replay: [[policy]] tables");
  Command command{"memory",
                  "What a scene and an avatar cost in time and memory before the first answer",
                  "Example:\n  foretouch-bench memory --scene kitchen.ply --scene-up z --avatar "
                  "man.avatar.json "
                  "--fidelity exact",
                  std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
