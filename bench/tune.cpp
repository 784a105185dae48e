#include "bench/tune.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/mesh/link_mesh.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/trade/runner.h"
#include "tools/console.h"
#include "tools/inputs/step_selection.h"
#include "tools/results_output.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// Coarser first.
constexpr Fidelity kFidelities[] = {Fidelity::Link, Fidelity::Exact};

/// Differences of percentiles below this factor may come from the machine's load.
constexpr double kAsQuick = 1.25;

int fineness(Fidelity fidelity) {
  return static_cast<int>(std::find(std::begin(kFidelities), std::end(kFidelities), fidelity) -
                          std::begin(kFidelities));
}

bool missedNothing(const TunedSetting& setting) {
  return setting.row.score.missed == 0 && setting.row.score.late == 0;
}

/// The surface of the avatar's meshes; none if it has none.
Result<std::optional<AvatarSurface>> surfaceOf(const BenchInputs& inputs) {
  bool hasMesh = false;
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    hasMesh = hasMesh || !inputs.avatar.mesh(link).file.empty();
  }
  if (!hasMesh) return std::optional<AvatarSurface>();
  FORETOUCH_TRY(auto meshes, loadLinkMeshes(inputs.avatar, inputs.files.avatarPath));
  FORETOUCH_TRY(auto surface, inFile(AvatarSurface::build(inputs.avatar, std::move(meshes)),
                                     inputs.files.avatarPath));
  surface.prepare();
  return std::optional<AvatarSurface>(std::move(surface));
}

class Tuner {
 public:
  Tuner(const TuneRequest& request, const BenchInputs& inputs, std::optional<AvatarSurface> surface)
      : request_(request),
        inputs_(inputs),
        surface_(std::move(surface)),
        world_(inputs.avatar, inputs.scene) {}

  Result<TunedRate> at(double rateHz) {
    FORETOUCH_TRY(const auto steps,
                  inFile(selectSteps(inputs_.clip, rateHz), inputs_.files.motionPath));
    FORETOUCH_TRY(auto run, runOf(rateHz, steps));
    TunedRate rate;
    rate.rateHz = rateHz;
    rate.takenHz = rateTaken(steps, inputs_.clip.frameTimeS);
    std::vector<TradeContender> contenders = contendersFor(rate.settings);
    FORETOUCH_TRY(auto result, runTrade(world_, surface_, run, contenders));
    std::vector<TradeRow>& rows = result.rows;
    for (std::size_t i = 0; i < rate.settings.size(); ++i) {
      rate.settings[i].rateHz = rateHz;
      rate.settings[i].row = rows[i];
      rate.settings[i].posesMissed = rows.back().score.missed;
    }
    rate.recommendation = recommended(rate.settings, request_.budgetUs);
    return rate;
  }

 private:
  /// One per setting, and last the poses alone.
  std::vector<TradeContender> contendersFor(std::vector<TunedSetting>& settings) {
    std::vector<TradeContender> contenders;
    for (const Fidelity fidelity : kFidelities) {
      const bool isExact = fidelity == Fidelity::Exact;
      if (isExact && !surface_) continue;
      for (const double tolerance : kTuneTolerances) {
        QueryOptions options;
        options.fidelity = fidelity;
        options.tolerance = tolerance;
        if (isExact) options.surface = surface_;
        contenders.push_back(
            {foretouchQuery(world_, options, toString(fidelity)), tolerance, isExact});
        TunedSetting setting;
        setting.fidelity = fidelity;
        setting.tolerance = tolerance;
        settings.push_back(std::move(setting));
      }
    }
    constexpr double kMargin = 1e-3;  // the margin of an engine's contacts (m)
    contenders.push_back({sampling(world_, 1, kMargin), kMargin, false});
    return contenders;
  }

  Result<TradeRun> runOf(double rateHz, const StepSelection& steps) {
    TradeRun run;
    run.rateHz = rateHz;
    run.stepMs = 1e3 * static_cast<double>(steps.stride) * inputs_.clip.frameTimeS;
    run.passes = request_.passes;
    const auto count = std::min(steps.count, static_cast<std::int64_t>(request_.steps));
    TradeWindow window;
    auto from = poseAt(0);
    if (!from.ok()) return from.error();
    for (std::int64_t step = 0; step < count; ++step) {
      auto to = poseAt((step + 1) * steps.stride);
      if (!to.ok()) return to.error();
      window.push_back({from.value(), to.value()});
      from = std::move(to);
    }
    run.windows.push_back(std::move(window));
    return run;
  }

  Result<Pose> poseAt(std::int64_t frame) {
    auto pose =
        validatedPose(inputs_.avatar.skeleton(), placedPose(inputs_, request_.placement, frame));
    if (!pose.ok()) return inFile(pose.error(), inputs_.files.motionPath);
    return pose;
  }

  const TuneRequest& request_;
  const BenchInputs& inputs_;
  std::optional<AvatarSurface> surface_;
  TradeWorld world_;
};

/// "30 Hz"; "33.33 Hz (--rate 30)" where no whole number of frames gives what was asked.
std::string rateInWords(const TunedRate& rate) {
  if (std::abs(rate.takenHz / rate.rateHz - 1.0) <= kRateSlack) {
    return fmt::format("{:g} Hz", rate.rateHz);
  }
  return fmt::format("{:.4g} Hz (--rate {:g})", rate.takenHz, rate.rateHz);
}

BenchTable tableOf(const TunedRate& rate, double budgetUs) {
  BenchTable table{
      "tried_at_" + fmt::format("{:g}", rate.rateHz) + "_hz",
      fmt::format("Tried at {}, {} steps ({} links touch, {} start in contact)", rateInWords(rate),
                  rate.settings.front().row.score.steps, rate.settings.front().row.score.contacts,
                  rate.settings.front().row.score.starts),
      {{"fidelity", "fidelity", 0},
       {"tolerance_m", "eps m", -1},
       {"mean_us", "mean us", 2},
       {"p50_us", "p50", 2},
       {"p99_us", "p99", 2},
       {"missed", "missed", 0},
       {"false", "false", 0},
       {"toi_error_max_ms", "early by at most ms", 3},
       {"within_budget", fmt::format("p99 <= {:g} us", budgetUs), 0},
       {"recommended", "", 0}},
      {}};
  for (std::size_t i = 0; i < rate.settings.size(); ++i) {
    const TunedSetting& s = rate.settings[i];
    const bool isIt = rate.recommendation && rate.recommendation->setting == i;
    table.rows.push_back({std::string(toString(s.fidelity)), s.tolerance, s.row.us.mean,
                          s.row.us.p50, s.row.us.p99, s.row.score.missed, s.row.score.falseOnes,
                          s.row.score.toiErrorMaxMs,
                          std::string(s.row.us.p99 <= budgetUs ? "yes" : "no"),
                          std::string(isIt ? "<- recommended" : "")});
  }
  return table;
}

Result<std::vector<double>> ratesOf(const TuneRequest& request, const BenchInputs& inputs) {
  if (request.rateHz) return std::vector<double>{*request.rateHz};
  std::vector<double> rates;
  for (const double rateHz : kTuneRatesHz) {
    if (selectSteps(inputs.clip, rateHz).ok()) {
      rates.push_back(rateHz);
    }
  }
  if (!rates.empty()) return rates;
  return Error::in(inputs.files.motionPath, ErrorCode::Empty,
                   "holds no step at 5 to 60 Hz; expected two frames or more, or a rate by --rate");
}

}  // namespace

std::optional<Recommendation> recommended(const std::vector<TunedSetting>& settings,
                                          double budgetUs) {
  double quickestUs = std::numeric_limits<double>::infinity();
  for (const TunedSetting& setting : settings) {
    if (missedNothing(setting)) quickestUs = std::min(quickestUs, setting.row.us.p99);
  }
  const bool isWithinBudget = quickestUs <= budgetUs;
  const double limitUs = isWithinBudget ? budgetUs : kAsQuick * quickestUs;
  const auto rank = [&](std::size_t i) {  // the least is the best
    const TunedSetting& s = settings[i];
    return std::tuple(s.row.score.falseOnes, -fineness(s.fidelity), s.tolerance);
  };
  std::optional<Recommendation> best;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (!missedNothing(settings[i]) || !(settings[i].row.us.p99 <= limitUs)) continue;
    if (!best || rank(i) < rank(best->setting)) best = Recommendation{i, isWithinBudget};
  }
  return best;
}

std::string recommendationText(const TunedRate& rate, double budgetUs) {
  if (!rate.recommendation) {
    return fmt::format("At {}: no setting can be recommended.", rateInWords(rate));
  }
  const TunedSetting& s = rate.settings[rate.recommendation->setting];
  std::string text = fmt::format(
      "At {}: --fidelity {} --tolerance {:g} --rate {:g}: p99 {:.1f} us, mean {:.1f} us, "
      "nothing missed of {} contacts, {} false; the poses alone miss {}.",
      rateInWords(rate), toString(s.fidelity), s.tolerance, rate.rateHz, s.row.us.p99,
      s.row.us.mean, s.row.score.contacts, s.row.score.falseOnes, s.posesMissed);
  if (!rate.recommendation->isWithinBudget) {
    text += fmt::format(
        " None keeps to {0:g} us at the 99th percentile: this is as quick as any; add --budget-us "
        "{0:g} to end steps there, with links Undecided rather than missed.",
        budgetUs);
  }
  return text;
}

Result<Tuned> tune(const TuneRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.files));
  FORETOUCH_TRY(const auto rates, ratesOf(request, inputs));
  FORETOUCH_TRY(auto surface, surfaceOf(inputs));
  const bool hasSurface = surface.has_value();
  Tuner tuner(request, inputs, std::move(surface));
  Tuned tuned;
  BenchReport& report = tuned.report;
  report = startedReport("tune", fmt::format("Settings for {:g} us a step", request.budgetUs));
  for (const double rateHz : rates) {
    FORETOUCH_TRY(auto rate, tuner.at(rateHz));
    report.tables.push_back(tableOf(rate, request.budgetUs));
    report.notes.push_back(recommendationText(rate, request.budgetUs));
    tuned.rates.push_back(std::move(rate));
  }
  report.workload = workloadFacts(inputs, inputs.scene, inputs.avatar, {});
  report.workload.pop_back();  // the fidelity: tries all
  report.notes.push_back(
      hasSurface ? "False: links reported though their LSS never come within the tolerance."
                 : "False: links reported though their LSS never come within the tolerance. The "
                   "avatar has no meshes, so exact was not tried.");
  report.notes.push_back(
      "Times are of this machine, warm, one thread, the least of a few passes a step: leave room.");
  return tuned;
}

namespace {

ExitCode run(const TuneRequest& request) {
  const BenchFiles& files = request.files;
  FORETOUCH_CHECK_OR(
      failed, checkIsNoInput(request.figures.json,
                             {files.scenePath, files.motionPath, files.avatarPath, files.mapPath}));
  FORETOUCH_TRY_OR(failed, const auto tuned, tune(request));
  return finished(tuned.report, {}, request.figures);
}

constexpr char kTuneFooter[] =
    R"(Tries fidelities and tolerances on your own scene, avatar and clip.
Examples:
  foretouch-bench tune --budget-us 20
  foretouch-bench tune --scene kitchen.ply --motion walk.bvh --clip-scale 0.01 --rate 30 --budget-us 50)";

}  // namespace

Command tuneCommand() {
  constexpr int kMostPasses = 1000;
  const auto asked = std::make_shared<TuneRequest>();
  TuneRequest& request = *asked;
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
  settings.output("--json", "FILE", request.figures.json, "Also write the figures to a file");
  Command command{
      "tune",
      "Find the settings for a scene, an avatar and a clip that keep each step within a time",
      kTuneFooter, std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
