#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/tune.h"
#include "tools/results_output.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedTune {
  TuneRequest request;
  std::string json;
};

ExitCode run(AskedTune& asked) {
  const BenchFiles& files = asked.request.files;
  FORETOUCH_CHECK_OR(failed, checkIsNoInput(asked.json, {files.scenePath, files.motionPath,
                                                         files.avatarPath, files.mapPath}));
  asked.request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto tuned, tune(asked.request));
  FORETOUCH_CHECK_OR(failed, writeReport(tuned.report, asked.json, {}, ""));
  printOut(reportText(tuned.report));
  return ExitCode::Done;
}

constexpr char kTuneFooter[] =
    R"(Tries fidelities and tolerances on your own scene, avatar and clip.
Examples:
  foretouch-bench tune --budget-us 20
  foretouch-bench tune --scene kitchen.ply --motion walk.bvh --clip-scale 0.01 --rate 30 --budget-us 50)";

}  // namespace

Command tuneCommand() {
  constexpr int kMostPasses = 1000;
  const auto asked = std::make_shared<AskedTune>();
  TuneRequest& request = asked->request;
  Settings settings;
  addBenchFiles(settings, request.files);
  addPlaceSetting(settings, request.placement, "Where the clip stands, as for replay");
  settings.number("--budget-us", "US", request.budgetUs, kAboveZero,
                  "Microseconds per step, at the 99th percentile");
  settings.number("--rate", "HZ", request.rateHz, kAboveZero, "",
                  "Poses per second; by default tries several");
  settings.whole("--steps", "N", request.steps, 1, kMaxBenchSteps,
                 "Steps tried at each rate at most");
  settings.whole("--passes", "N", request.passes, 1, kMostPasses,
                 "Over all steps; a step's least time counts");
  settings.output("--json", "FILE", asked->json, "Also write the figures to a file");
  Command command{
      "tune",
      "Find the settings for a scene, an avatar and a clip that keep each step within a time",
      kTuneFooter, std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
