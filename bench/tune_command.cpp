#include "bench/tune_command.h"

#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/tune.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct TuneTexts {
  std::string scene, motion, avatar, map, place, rate, json;
  std::string sceneScale = "1", scale = "1", up = "y", motionUp = "y";
  std::string budgetUs = "20", steps = "400", passes = "3";
};

Result<TuneRequest> settledTune(const TuneTexts& texts) {
  constexpr int kMostPasses = 1000;
  TuneRequest request;
  Settling settle;
  request.files.scenePath = texts.scene;
  request.files.motionPath = texts.motion;
  request.files.avatarPath = texts.avatar;
  request.files.mapPath = texts.map;
  settle.into(request.files.sceneScale, parsePositive("--scene-scale", texts.sceneScale));
  settle.into(request.files.motionScale, parsePositive("--clip-scale", texts.scale));
  settle.into(request.files.sceneUp, parseUpAxis("--scene-up", texts.up));
  settle.into(request.files.motionUp, parseUpAxis("--clip-up", texts.motionUp));
  settle.into(request.budgetUs, parsePositive("--budget-us", texts.budgetUs));
  int steps = 0;
  settle.into(steps, parseCount("--steps", texts.steps, kMaxBenchSteps));
  settle.into(request.passes, parseCount("--passes", texts.passes, kMostPasses));
  if (!texts.place.empty()) {
    settle.into(request.placement, parsePlacement("--place", texts.place));
  }
  if (!texts.rate.empty()) {
    double rateHz = 0.0;
    settle.into(rateHz, parsePositive("--rate", texts.rate));
    request.rateHz = rateHz;
  }
  if (settle.error()) return *settle.error();
  const auto output =
      checkIsNoInput(texts.json, {texts.scene, texts.motion, texts.avatar, texts.map});
  if (!output.ok()) return output.error();
  request.steps = countOf(steps);
  request.command = ownCommandLine();
  return request;
}

ExitCode run(const TuneTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledTune(texts));
  FORETOUCH_TRY_OR(failed, const auto tuned, tune(request));
  const BenchTable none;
  FORETOUCH_CHECK_OR(failed, writeReport(tuned.report, texts.json, none, ""));
  printOut(reportText(tuned.report));
  return ExitCode::Done;
}

constexpr char kTuneFooter[] =
    R"(Tries fidelities and tolerances on your own scene, avatar and clip.
Examples:
  foretouch-bench tune --budget-us 20
  foretouch-bench tune --scene kitchen.ply --motion walk.bvh --clip-scale 0.01 --rate 30 --budget-us 50)";

}  // namespace

void addTuneCommand(CLI::App& program, ExitCode& exit) {
  const auto texts = std::make_shared<TuneTexts>();
  CLI::App* const command = program.add_subcommand(
      "tune",
      "Find the settings for a scene, an avatar and a clip that keep each step within a time");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scene", texts->scene, "FILE", "Scene; the bundled room if not given");
  option("--motion", texts->motion, "CLIP", "Clip; the bundled one if not given");
  option("--avatar", texts->avatar, "FILE", "Avatar; one LSS a bone of the clip if not given");
  option("--map", texts->map, "FILE", "Joint names that differ, as for replay");
  option("--clip-scale,--scale", texts->scale, "S", "Metres per unit of the clip");
  option("--clip-up,--motion-up", texts->motionUp, "y|z", "Which axis of the clip points up");
  option("--scene-scale", texts->sceneScale, "S", "Metres per unit of the scene");
  option("--scene-up,--up", texts->up, "y|z", "Which axis of the scene points up");
  option("--place", texts->place, "X,Y,Z[,YAW]", "Where the clip stands, as for replay");
  option("--budget-us", texts->budgetUs, "US", "Microseconds per step, at the 99th percentile");
  option("--rate", texts->rate, "HZ", "Poses per second; by default tries several");
  option("--steps", texts->steps, "N", "Steps tried at each rate at most");
  option("--passes", texts->passes, "N", "Over all steps; a step's least time counts");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  command->footer(kTuneFooter);
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
