// bench/solid.cpp: `foretouch-bench solid`: how a solid avatar feels, what it costs, and whether it
// keeps its promises, beside the usual ways; and the goals that it is held to.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/result.h"
#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/report.h"
#include "bench/solid/busy_places.h"
#include "bench/solid/cast.h"
#include "bench/solid/explain.h"
#include "bench/solid/feel.h"
#include "bench/solid/feel_tables.h"
#include "bench/solid/figure.h"
#include "bench/solid/followers.h"
#include "bench/solid/trial_tables.h"
#include "tools/progress.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// Clips in scenes, and the trials of bench/solid/trial_tables.h.
constexpr const char* kSolidParts[] = {"scenes", "board", "boards", "clutter",
                                       "slide",  "press", "fingers"};

struct SolidBenchRequest {
  std::string dataFolder;  ///< With mocap/ and scenes/; empty: the bundled room and dancer alone.
  std::vector<std::string> scenes, clips;  ///< By name; empty: kitchen, office and room; six clips.
  std::vector<double> ratesHz{90.0};
  int places = 2;                  ///< Per clip and scene.
  double seconds = 4.0;            ///< For each place.
  std::vector<std::string> parts;  ///< Some of kSolidParts; empty: all.
  bool mustExplain = false;        ///< What holds it, and what its slowest ticks are made of.
  TrialRequest trials;             ///< Its options and seed are also those of the scenes.
  FigureFiles figures;
};

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
      if (request_.mustExplain) {
        FORETOUCH_TRY(const auto explained,
                      explain(stage_, actor, tracked, rateHz, request_.trials.options));
        explained_.add(explained);
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
  [[nodiscard]] const ExplainTally& explained() const { return explained_; }
  [[nodiscard]] int places() const { return places_; }

 private:
  const SolidBenchRequest& request_;
  const SolidStage& stage_;
  FeelTally solid_, hold_;
  RestTally rest_;
  HandsTrial hands_;
  ExplainTally explained_;
  int places_ = 0;
};

/// The tables of scenes: what they have in common over all of them.
class SceneTables {
 public:
  SceneTables() : rest_(emptyRestTable()), hands_(emptyHandsTable()) {}

  void add(const SolidStage& stage, double rateHz, const SceneRun& run, JudgedReport& bench) {
    feel_.add({stage.name, rateHz, run.places(), "hold"}, run.hold());
    feel_.add({stage.name, rateHz, run.places(), "solid"}, run.solid());
    addRow({stage.name, rateHz}, run.rest(), rest_);
    addRows({stage.name, rateHz}, run.hands().tallies(), hands_);
    if (!run.explained().ticks.empty()) explained_.add(stage.name, rateHz, run.explained());
    for (const WayTally* way : {&run.solid().way, &run.rest().way}) {
      bench.violations += way->violations();
      for (const std::string& finding : way->findings) bench.report.notes.push_back(finding);
    }
  }
  void appendTo(BenchReport& report) const {
    feel_.appendTo(report);
    if (!rest_.rows.empty()) report.tables.push_back(rest_);
    report.tables.push_back(hands_);
    explained_.appendTo(report);
  }

 private:
  FeelTables feel_;
  BenchTable rest_, hands_;
  ExplainTables explained_;
};

Result<Done> measureScenes(const SolidBenchRequest& request, JudgedReport& bench) {
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

using Trial = Result<JudgedTable> (*)(const TrialRequest&);

/// One thread.
Result<JudgedReport> measureSolid(const SolidBenchRequest& request) {
  JudgedReport bench{
      startedReport("solid", "A solid avatar: what is shown passes through nothing")};
  BenchReport& report = bench.report;
  report.workload = {{"skin", fmt::format("{:g} m", request.trials.options.skin)},
                     {"tolerance", fmt::format("{:g} m", request.trials.options.tolerance)}};
  if (isAsked(request.parts, "scenes")) FORETOUCH_CHECK(measureScenes(request, bench));
  const std::pair<const char*, Trial> trials[] = {
      {"board", boardTable}, {"boards", boardsTable}, {"clutter", clutterTable},
      {"slide", slideTable}, {"press", pressTable},   {"fingers", fingersTable}};
  for (const auto& [part, trial] : trials) {
    if (!isAsked(request.parts, part)) continue;
    FORETOUCH_TRY(auto result, trial(request.trials));
    bench.add(std::move(result));
  }
  return bench;
}

ExitCode run(SolidBenchRequest& request) {
  /// Share of the skin, as SolidOptions has them.
  constexpr double kToleranceShare = 0.25;
  request.trials.options.tolerance = kToleranceShare * request.trials.options.skin;
  FORETOUCH_TRY_OR(failed, const auto bench, measureSolid(request));
  return finished(bench, "ticks broke the promise", request.figures);
}

void addTrials(Settings& settings, TrialRequest& trials) {
  constexpr int kMostSeed = 1'000'000'000, kMostTrials = 100'000'000;
  settings.whole("--seed", "N", trials.seed, 1, kMostSeed, "Of the places");
  settings.number("--skin", "M", trials.options.skin, kAboveZero,
                  "Gap that the avatar keeps; the tolerance is a quarter of it");
  settings.whole("--goals", "N", trials.goals, 1, kMostTrials, "Free places among clutter");
  settings.whole("--board-trials", "N", trials.boardTrials, 1, kMostTrials,
                 "Hands led through a board, in all; of other hands 200 per speed and depth");
}

}  // namespace

Command solidBenchCommand() {
  constexpr int kMostPlaces = 1000;
  const auto asked = std::make_shared<SolidBenchRequest>();
  SolidBenchRequest& request = *asked;
  Settings settings;
  addData(settings, request.dataFolder, "With mocap/ and scenes/; $FORETOUCH_DATA says another");
  addWords(settings, "--scenes", "NAME,...", request.scenes, {},
           "kitchen, office, collision-world, undulating, room; kitchen,office,room if not given");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths; six if not given");
  addWords(settings, "--parts", "NAME,...", request.parts,
           {std::begin(kSolidParts), std::end(kSolidParts)},
           "scenes (clips in furniture), board, boards, clutter, slide, press, fingers; all if not "
           "given");
  addNumbers(settings, "--rates", "HZ,...", request.ratesHz, kAboveZero,
             "Tracked poses per second");
  settings.whole("--places", "N", request.places, 1, kMostPlaces, "Busy places per clip and scene");
  settings.flag("--explain", request.mustExplain,
                "Also what holds each link, and on what the slowest ticks spend their time");
  settings.number("--seconds", "S", request.seconds, kAboveZero, "Of the clip at each place");
  addTrials(settings, request.trials);
  addFigures(settings, request.figures, "Also write the first table to a file");
  Command command{
      "solid", "How a solid avatar feels and what it costs; exit code 1 where it breaks a promise",
      "Example:\n  foretouch-bench solid --scenes office --rates 90,30,10", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
