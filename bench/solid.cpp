#include "bench/solid.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/solid/busy_places.h"
#include "bench/solid/cast.h"
#include "bench/solid/feel.h"
#include "bench/solid/feel_tables.h"
#include "bench/solid/figure.h"
#include "bench/solid/followers.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

/// Keeps what another follower shows.
class Recorder final : public Follower {
 public:
  explicit Recorder(Follower& follower) : follower_(follower) {}
  Result<Done> follow(const Pose& tracked, double dtS, SolidTick& tick) override {
    FORETOUCH_CHECK(follower_.follow(tracked, dtS, tick));
    shown_.poses.push_back(tick.shown);
    shown_.lift.push_back(tick.lift);
    return Done{};
  }
  [[nodiscard]] const ShownPoses& shown() const { return shown_; }

 private:
  Follower& follower_;
  ShownPoses shown_;
};

/// One scene at one rate: all clips at all of their places, by each follower.
class SceneRun {
 public:
  SceneRun(const SolidBenchRequest& request, const SolidStage& stage)
      : request_(request), stage_(stage), hands_(stage) {}

  Result<Done> add(const SolidActor& actor, double rateHz) {
    BusyPlaceRequest places;
    places.count = request_.places;
    places.seconds = std::min(request_.seconds, actor.clip.durationS());
    places.seed = request_.trials.seed;
    for (const BusyPlace& place : busyPlaces(stage_, actor, places)) {
      const auto tracked =
          trackedPoses(actor, place.placement, rateHz, place.fromS, places.seconds);
      FeelRun run{fmt::format("{} in {} at {:g} Hz, seed {}", actor.name, stage_.name, rateHz,
                              request_.trials.seed),
                  rateHz, request_.trials.options.tolerance, request_.trials.options.catchUp};
      FORETOUCH_TRY(auto solid, solidFollower(actor.avatar, stage_.scene, request_.trials.options));
      Recorder recorder(*solid);
      FORETOUCH_TRY(const auto bySolid, feel(stage_, actor, tracked, run, recorder));
      FORETOUCH_TRY(auto hold, holdingFollower(actor.avatar, stage_.scene, kHoldSkin));
      run.tolerance = kHoldSkin;
      FORETOUCH_TRY(const auto byHold, feel(stage_, actor, tracked, run, *hold));
      hands_.add(actor, tracked, recorder.shown(), rateHz);
      if (rateHz == kTrialRateHz) {
        FORETOUCH_TRY(const auto rest, tryRest(stage_, actor, tracked, request_.trials.options));
        rest_.add(rest);
      }
      solid_.add(bySolid);
      hold_.add(byHold);
      ++places_;
    }
    return Done{};
  }

  [[nodiscard]] const FeelTally& solid() const { return solid_; }
  [[nodiscard]] const FeelTally& hold() const { return hold_; }
  [[nodiscard]] const RestTally& rest() const { return rest_; }
  [[nodiscard]] const HandsTrial& hands() const { return hands_; }
  [[nodiscard]] int places() const { return places_; }

 private:
  const SolidBenchRequest& request_;
  const SolidStage& stage_;
  FeelTally solid_, hold_;
  RestTally rest_;
  HandsTrial hands_;
  int places_ = 0;
};

/// The tables of scenes: what they have in common over all of them.
class SceneTables {
 public:
  SceneTables() : rest_(emptyRestTable()), hands_(emptyHandsTable()) {}

  void add(const SolidStage& stage, double rateHz, const SceneRun& run, SolidBench& bench) {
    feel_.add({stage.name, rateHz, run.places(), "hold"}, run.hold());
    feel_.add({stage.name, rateHz, run.places(), "solid"}, run.solid());
    addRow({stage.name, rateHz}, run.rest(), rest_);
    addRows({stage.name, rateHz}, run.hands().tallies(), hands_);
    for (const WayTally* way : {&run.solid().way, &run.rest().way}) {
      bench.violations += way->violations();
      for (const std::string& finding : way->findings) bench.report.notes.push_back(finding);
    }
  }
  void appendTo(BenchReport& report) const {
    feel_.appendTo(report);
    if (!rest_.rows.empty()) report.tables.push_back(rest_);
    report.tables.push_back(hands_);
  }

 private:
  FeelTables feel_;
  BenchTable rest_, hands_;
};

Result<Done> measureScenes(const SolidBenchRequest& request, SolidBench& bench) {
  FORETOUCH_TRY(const auto cast, loadCast(request.dataFolder, request.scenes, request.clips));
  SceneTables tables;
  ProgressBar progress("solid", static_cast<std::int64_t>(cast.stages.size() * cast.actors.size() *
                                                          request.ratesHz.size()));
  std::int64_t done = 0;
  for (const SolidStage& stage : cast.stages) {
    for (const double rateHz : request.ratesHz) {
      SceneRun run(request, stage);
      for (const SolidActor& actor : cast.actors) {
        FORETOUCH_CHECK(run.add(actor, rateHz));
        progress.advanceTo(++done);
      }
      if (run.places() > 0) tables.add(stage, rateHz, run, bench);
    }
  }
  tables.appendTo(bench.report);
  std::vector<std::string> clips;
  for (const SolidActor& actor : cast.actors) clips.push_back(actor.name);
  bench.report.workload.emplace_back("clips", listed(clips));
  if (!cast.leftOut.empty()) bench.report.workload.emplace_back("absent", listed(cast.leftOut));
  return Done{};
}

using Trial = Result<TrialTable> (*)(const TrialRequest&);

}  // namespace

Result<SolidBench> measureSolid(const SolidBenchRequest& request) {
  const auto isAsked = [&](const std::string& part) {
    return request.parts.empty() ||
           std::find(request.parts.begin(), request.parts.end(), part) != request.parts.end();
  };
  SolidBench bench;
  BenchReport& report = bench.report;
  report.kind = "solid";
  report.title = "A solid avatar: what is shown passes through nothing";
  report.command = request.command;
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = {{"skin", fmt::format("{:g} m", request.trials.options.skin)},
                     {"tolerance", fmt::format("{:g} m", request.trials.options.tolerance)}};
  if (isAsked("scenes")) FORETOUCH_CHECK(measureScenes(request, bench));
  const std::pair<const char*, Trial> trials[] = {{"board", boardTable},
                                                  {"clutter", clutterTable},
                                                  {"slide", slideTable},
                                                  {"press", pressTable}};
  for (const auto& [part, trial] : trials) {
    if (!isAsked(part)) continue;
    FORETOUCH_TRY(auto result, trial(request.trials));
    report.tables.push_back(std::move(result.table));
    bench.violations += result.violations;
  }
  return bench;
}

}  // namespace foretouch::tools
