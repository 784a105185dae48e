#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/compare.h"
#include "tools/inputs/policy_rules.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

struct AskedComparison {
  ReplayRequest request;
  std::string json;
};

ExitCode run(AskedComparison& asked) {
  ReplayRequest& request = asked.request;
  if (request.budgetUs > 0) {
    return failed(Error::in("--budget-us", ErrorCode::Mismatch,
                            "expected none: what is undecided has nothing to compare"));
  }
  FORETOUCH_CHECK_OR(failed, readPolicies(request));
  if (!asked.json.empty()) {
    FORETOUCH_CHECK_OR(
        failed, checkOutput(asked.json, {request.scenePath, request.avatarPath, request.motionPath,
                                         request.mapPath, request.robotPath, request.policyPath}));
  }
  FORETOUCH_TRY_OR(failed, const auto report, measureComparison(request));
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, {}, ""));
  printOut(reportText(report));
  return ExitCode::Done;
}

}  // namespace

Command compareCommand() {
  const auto asked = std::make_shared<AskedComparison>();
  Settings settings;
  addSceneSettings(settings, asked->request);
  settings.of("--scene").required();
  addAvatarSetting(settings, asked->request).required();
  addMotionSetting(settings, asked->request, "--motion", "CLIP").required();
  addRateSetting(settings, asked->request);
  addClipSettings(settings, asked->request);
  addQuerySettings(settings, asked->request);
  settings.of("--fidelity").only({"link", "exact"});
  settings.path("--policy", "FILE", asked->request.policyPath, "As of replay: [[policy]] tables");
  settings.output("--json", "FILE", asked->json, "Also write the figures to a file");
  Command command{"compare",
                  "What a check of the poses, rigid links and, at exact fidelity, LSS make of a "
                  "clip's contacts",
                  "Example:\n  foretouch-bench compare --scene kitchen.ply --scene-up z --avatar "
                  "man.avatar.json --motion kick.bvh --clip-scale 0.01 --rate 10",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
