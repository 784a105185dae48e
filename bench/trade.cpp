#include "bench/trade.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/trade/dominance.h"
#include "bench/trade/runner.h"
#include "bench/trade/trade_tables.h"
#include "tools/console.h"
#include "tools/inputs/step_selection.h"
#include "tools/report/document_parts.h"

namespace foretouch::tools {
namespace {

void noteOnce(std::string note, BenchReport& report) {
  auto& notes = report.notes;
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
}

/// A clip's placement, and the frame around which to measure.
struct TradePlace {
  Placement placement;
  double middleS = 0.0;
};

std::vector<TradeContender> contendersFor(const TradeWorld& world,
                                          const std::vector<double>& tolerances,
                                          const std::optional<AvatarSurface>& surface) {
  std::vector<TradeContender> all;
  for (const double tolerance : tolerances) {
    const auto add = [&](std::unique_ptr<Strategy> strategy, bool isExact = false) {
      all.push_back({std::move(strategy), tolerance, isExact});
    };
    for (const int instants : {1, 4, 16, 64}) add(sampling(world, instants, tolerance));
    add(voxelSweep(world));
    add(subdivision(world, tolerance));
    add(advancement(world, tolerance));
    add(certificates(world, tolerance));
    QueryOptions options;
    options.tolerance = tolerance;
    ReferenceOptions scalar;
    scalar.backtracking = Backtracking::Scalar;
    add(foretouchQuery(world, options, "Foretouch, scalar", scalar));
    add(foretouchQuery(world, options, "Foretouch"));
    for (const Rung rung : {Rung::Limb, Rung::Avatar, Rung::Ellipsoid}) {
      ReferenceOptions above;
      above.rung = rung;
      add(foretouchQuery(world, options, std::string("Foretouch, ") + toString(rung), above));
    }
    if (!surface) continue;
    options.fidelity = Fidelity::Exact;
    options.surface = surface;
    add(foretouchQuery(world, options, "Foretouch, exact"), true);
  }
  return all;
}

/// One scene and clip.
class WorldBench {
 public:
  WorldBench(const TradeRequest& request, const BenchInputs& inputs, BenchBody body,
             std::optional<AvatarSurface> surface)
      : request_(request),
        inputs_(inputs),
        body_(std::move(body)),
        surface_(std::move(surface)),
        world_(inputs.avatar, inputs.scene) {}

  Result<Done> run(MeasuredTrade& bench, JudgedTruth& judged) {
    FORETOUCH_TRY(const auto places, findPlaces());
    bool isJudged = false;
    for (const double rateHz : request_.ratesHz) {
      FORETOUCH_TRY(auto run, runAt(rateHz, places));
      if (run.windows.empty()) {
        noteOnce(fmt::format("{} holds no steps at {:g} Hz.", fileName(inputs_.files.motionPath),
                             rateHz),
                 bench.report);
        continue;
      }
      if (!isJudged) run.judged = request_.judged;
      isJudged = true;
      auto contenders = contendersFor(world_, request_.tolerances, surface_);
      FORETOUCH_TRY(auto result, runTrade(world_, surface_, run, contenders));
      judged.add(result.judged);
      for (TradeRow& row : result.rows) bench.rows.push_back(std::move(row));
    }
    return Done{};
  }

 private:
  /// The places at which the workload of `bench latency` finds contacts, one step of each.
  Result<std::vector<TradePlace>> findPlaces() {
    WorkloadRequest wanted = request_.workload;
    const double clipHz = 1.0 / inputs_.clip.frameTimeS;
    wanted.rateHz = std::min(request_.baseRateHz, clipHz);
    FORETOUCH_TRY(const auto workload, chooseSteps(inputs_, body_, wanted));
    std::vector<TradePlace> places;
    std::optional<Placement> last;
    for (const StepPick& pick : workload.picks) {
      const bool isKnown =
          last && last->origin == pick.placement.origin && last->yawDeg == pick.placement.yawDeg;
      if (isKnown || pick.kind != StepClass::Contact) continue;
      if (places.size() == static_cast<std::size_t>(request_.places)) break;
      last = pick.placement;
      const double frame =
          static_cast<double>(pick.frame) + 0.5 * static_cast<double>(workload.stride);
      places.push_back({pick.placement, frame * inputs_.clip.frameTimeS});
    }
    if (!places.empty()) return places;
    return Error::in(inputs_.files.motionPath, ErrorCode::Empty,
                     "touches nothing at any place that was tried in " +
                         fileName(inputs_.files.scenePath) + "; expected one with a contact");
  }

  Result<TradeRun> runAt(double rateHz, const std::vector<TradePlace>& places) {
    TradeRun run;
    run.scene = fileName(inputs_.files.scenePath);
    run.clip = fileName(inputs_.files.motionPath);
    run.rateHz = rateHz;
    run.passes = request_.passes;
    const auto steps = selectSteps(inputs_.clip, rateHz);
    if (!steps.ok()) return run;  // a rate that the clip does not have
    run.stepMs = 1e3 * static_cast<double>(steps.value().stride) * inputs_.clip.frameTimeS;
    for (const TradePlace& place : places) {
      FORETOUCH_TRY(auto window, windowAt(place, steps.value().stride));
      if (!window.empty()) run.windows.push_back(std::move(window));
    }
    return run;
  }

  Result<TradeWindow> windowAt(const TradePlace& place, std::int64_t stride) {
    const double frameTimeS = inputs_.clip.frameTimeS;
    const auto lastFrame = static_cast<std::int64_t>(inputs_.clip.frames.size()) - 1;
    const auto wanted = static_cast<std::int64_t>(std::llround(request_.seconds / frameTimeS));
    const std::int64_t span = std::min(lastFrame, wanted);
    const auto middle = static_cast<std::int64_t>(std::llround(place.middleS / frameTimeS));
    const std::int64_t first = std::clamp<std::int64_t>(middle - span / 2, 0, lastFrame - span);
    TradeWindow window;
    for (std::int64_t frame = first; frame + stride <= first + span; frame += stride) {
      FORETOUCH_TRY(auto from, poseAt(place, frame));
      FORETOUCH_TRY(auto to, poseAt(place, frame + stride));
      window.push_back({std::move(from), std::move(to)});
    }
    return window;
  }

  Result<Pose> poseAt(const TradePlace& place, std::int64_t frame) {
    return validatedPose(inputs_.avatar.skeleton(), placedPose(inputs_, place.placement, frame));
  }

  const TradeRequest& request_;
  const BenchInputs& inputs_;
  BenchBody body_;
  std::optional<AvatarSurface> surface_;
  TradeWorld world_;
};

Result<Done> measureWorld(const TradeRequest& request, const BenchFiles& files,
                          MeasuredTrade& bench, JudgedTruth& judged) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(files));
  FORETOUCH_TRY(auto body, bodyOf(inputs, 0));
  BenchOptions options;
  options.fidelity = Fidelity::Exact;
  options.surfaceTriangles = request.surfaceTriangles;
  FORETOUCH_TRY(auto query, queryFor(inputs, body, options));
  for (auto& fact : workloadFacts(inputs, inputs.scene, inputs.avatar, query)) {
    const bool isKnown = std::find(bench.report.workload.begin(), bench.report.workload.end(),
                                   fact) != bench.report.workload.end();
    if (!isKnown && fact.first != "fidelity") bench.report.workload.push_back(std::move(fact));
  }
  WorldBench world(request, inputs, std::move(body), std::move(query).surface);
  return world.run(bench, judged);
}

void addNotes(const TradeRequest& request, const JudgedTruth& judged,
              const std::vector<TradeRow>& rows, BenchReport& report) {
  report.notes.push_back(dominanceText(dominanceOf(rows)));
  report.notes.push_back(fmt::format(
      "Windows of {:g} s of the clip at up to {} places a scene, every step of them; one thread. A "
      "strategy goes through a window as a stream would bring it, strategies take turns window by "
      "window, and of {} passes a step's least time counts.",
      request.seconds, request.places, request.passes));
  report.notes.push_back(fmt::format(
      "Truth: the scalar form at {:g} m, on bodies thinner and thicker, so that what is called "
      "missed, late or false is so beyond doubt. A judge of other code "
      "(judge/hull_oracle.h) "
      "was asked about {} links: {} were free as long as told ({} undecided within its budget), "
      "{} of {} contacts touched by when told, {} answers differed.",
      kTruthTolerance, judged.links, judged.free, judged.open, judged.touching, judged.contacts,
      judged.wrong));
  report.notes.push_back(
      "All but Foretouch look distances up in one plain tree of boxes, in doubles and without "
      "proof of rounding: compare them with one another and with Foretouch, scalar; the time that "
      "separates these from Foretouch is its tree and its lanes as much as its strategy.");
  report.notes.push_back(
      "Sampling and poses take the tolerance as a margin within which a link counts as touching. "
      "Distance error: how far from touching a link is when its contact is reported, false ones "
      "included, starts not; exact is held against the truth of its surface, and its distance is "
      "not told.");
}

}  // namespace

Result<MeasuredTrade> measureTrade(const TradeRequest& request) {
  MeasuredTrade bench;
  BenchReport& report = bench.report;
  report = startedReport("trade", "Speed for accuracy");
  JudgedTruth judged;
  for (const BenchFiles& files : request.worlds) {
    FORETOUCH_CHECK(measureWorld(request, files, bench, judged));
  }
  if (bench.rows.empty()) {
    return Error::in("--rate", ErrorCode::Empty, "expected a rate that a clip has");
  }
  markFrontier(bench.rows);
  report.tables = tablesForPeople(bench.rows, request.baseTolerance, request.baseRateHz);
  addNotes(request, judged, bench.rows, report);
  return bench;
}

}  // namespace foretouch::tools
