#include "bench/peers.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/import/scene_import.h"
#include "assets/text_file.h"
#include "bench/commands.h"
#include "bench/inputs.h"
#include "bench/judged.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/peers/foretouch_solvers.h"
#include "bench/peers/peer_solvers.h"
#include "bench/report.h"
#include "bench/scene.h"
#include "lss/index.h"
#include "tools/inputs/example_folder.h"
#include "tools/progress.h"
#include "tools/report/document_parts.h"
#include "tools/results_output.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/lists.h"

namespace foretouch::tools {
namespace {

std::int64_t roundsOf(const SweepSolvers& solvers, const RoundCounts& rounds) {
  std::int64_t count = 0;
  for (const auto& solver : solvers) count += solver->isPeer() ? rounds.peers : rounds.own;
  return count;
}

std::int64_t asCell(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

std::vector<BenchCell> rowOf(const SolverRun& run, const Judgement& j) {
  return {run.name,           j.time.medianUs,  j.time.meanUs,
          j.time.p99Us,       asCell(j.missed), asCell(j.missedDeep),
          asCell(j.late),     1e3 * j.latestM,  asCell(j.falseHits),
          asCell(j.falseFar), j.medianToiError, j.p99ToiError};
}

BenchTable tableOf(const ComparedSet& set) {
  BenchTable table;
  table.name = set.motions.name;
  std::transform(table.name.begin(), table.name.end(), table.name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  table.title = fmt::format("{}: {}; {} motions, {} of them in contact", set.motions.name,
                            set.motions.description, set.motions.sweeps.size(),
                            set.judgements.front().contacts);
  table.columns = {{"solver", "solver and setting"},
                   {"median_us", "median us"},
                   {"mean_us", "mean us"},
                   {"p99_us", "p99 us"},
                   {"missed", "missed"},
                   {"missed_deep", "deep"},
                   {"late", "late"},
                   {"latest_mm", "latest mm", 3},
                   {"false", "false"},
                   {"false_far", "far"},
                   {"toi_error_median", "toi error, median", 7},
                   {"toi_error_p99", "p99", 7}};
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    table.rows.push_back(rowOf(set.runs[i], set.judgements[i]));
  }
  return table;
}

BenchTable fasterTable(const std::vector<ComparedSet>& sets) {
  BenchTable table{"faster",
                   "Foretouch and the fastest peer that misses nothing and is never late",
                   {{"set", "set"},
                    {"solver", "Foretouch at"},
                    {"mean_us", "mean us"},
                    {"median_us", "median us"},
                    {"peer", "fastest sound peer"},
                    {"peer_mean_us", "its mean us"},
                    {"times_faster", "times faster", 1}},
                   {}};
  for (const ComparedSet& set : sets) {
    const auto fastest = fastestSoundPeer(set.runs, set.judgements);
    if (!fastest) continue;
    const double peerUs = set.judgements[*fastest].time.meanUs;
    for (std::size_t i = 0; i < set.runs.size(); ++i) {
      if (set.runs[i].isPeer) continue;
      const TimeFigures& own = set.judgements[i].time;
      table.rows.push_back({set.motions.name, set.runs[i].name, own.meanUs, own.medianUs,
                            set.runs[*fastest].name, peerUs, peerUs / own.meanUs});
    }
  }
  return table;
}

}  // namespace

bool hasPeers() {
#ifdef FORETOUCH_HAS_PEERS
  return true;
#else
  return false;
#endif
}

std::string builtInPeers() {
#ifdef FORETOUCH_HAS_PEERS
  return peerVersions();
#else
  return "";
#endif
}

Result<std::vector<ComparedSet>> comparePeers(
    const Scene& scene, const PeersPlan& plan,
    const std::function<void(std::int64_t, std::int64_t)>& progress) {
  const std::vector<Triangle> triangles = finiteTriangles(scene);
  const oracle::Scene reference(plain(triangles));
#ifdef FORETOUCH_HAS_PEERS
  const PeerScenes peers(triangles);
#endif
  std::vector<ComparedSet> compared;
  std::int64_t done = 0;
  for (const MotionSetKind& kind : plan.sets) {
    FORETOUCH_TRY(auto motions, drawnSet(kind, reference, plan.motions, plan.seed));
    ComparedSet set{std::move(motions), {}, {}};
    FORETOUCH_TRY(auto solvers, foretouchSolvers(scene, set.motions.lss_L));
    SweepSolvers all = std::move(solvers);
#ifdef FORETOUCH_HAS_PEERS
    for (auto& solver : peers.solvers(set.motions.lss_L)) all.push_back(std::move(solver));
#endif
    const auto total = static_cast<std::int64_t>(plan.sets.size()) * roundsOf(all, plan.rounds);
    set.runs = runSolvers(set.motions, all, plan.rounds, [&] { progress(++done, total); });
    for (const SolverRun& run : set.runs) set.judgements.push_back(judged(set.motions, run));
    compared.push_back(std::move(set));
  }
  return compared;
}

std::vector<BenchTable> peerTables(const std::vector<ComparedSet>& sets) {
  std::vector<BenchTable> tables;
  for (const ComparedSet& set : sets) tables.push_back(tableOf(set));
  tables.push_back(fasterTable(sets));
  return tables;
}

BenchTable rawPeerTable(const std::vector<ComparedSet>& sets) {
  BenchTable table{"motions",
                   "Every motion and solver",
                   {{"set", "set"},
                    {"motion", "motion"},
                    {"solver", "solver and setting"},
                    {"us", "us"},
                    {"touches", "touches"},
                    {"toi", "toi"},
                    {"true_touches", "in truth"},
                    {"true_toi", "true toi"}},
                   {}};
  for (const ComparedSet& set : sets) {
    for (const SolverRun& run : set.runs) {
      for (std::size_t i = 0; i < run.answers.size(); ++i) {
        const SweepTruth& truth = set.motions.truths[i];
        table.rows.push_back({set.motions.name, asCell(i), run.name, run.us[i],
                              std::int64_t{run.answers[i].touches}, run.answers[i].toi,
                              std::int64_t{truth.touches}, truth.toi});
      }
    }
  }
  return table;
}

std::vector<std::string> peerNotes(const std::vector<ComparedSet>& sets) {
  std::size_t uncertain = 0;
  for (const ComparedSet& set : sets) uncertain += set.motions.uncertain;
  return {fmt::format("Truth: conservative advancement to {:g} m by code of its own; motions drawn "
                      "and left out because it stayed uncertain: {}.",
                      oracle::kTouchSeparation, uncertain),
          fmt::format("missed: contacts not reported; deep: of these, deeper than {0:g} m. late: "
                      "reported more than {0:g} m of motion after the contact; latest: the most. "
                      "false: contacts reported on free motions; far: of these, on motions that "
                      "never come within {0:g} m.",
                      kJudgedDistance),
          "Times: CPU time of the thread for one motion of one link, building Foretouch's motion "
          "and the peers' transforms included; mean, median and p99 over the motions.",
          "Time of impact: in units of the motion. A sound peer misses nothing and is never late."};
}

std::size_t brokenPromises(const std::vector<ComparedSet>& sets) {
  std::size_t broken = 0;
  for (const ComparedSet& set : sets) {
    for (std::size_t i = 0; i < set.runs.size(); ++i) {
      if (set.runs[i].isPeer) continue;
      broken += set.judgements[i].missed + set.judgements[i].late;
    }
  }
  return broken;
}

namespace {

constexpr int kMostMotions = 1'000'000, kMostRounds = 1'000, kMostTriangles = 5'000'000;

struct PeersRequest {
  PeersPlan plan;
  std::vector<std::string> sets;  ///< Empty: all.
  std::string scenePath;
  double sceneScale = 1.0;
  UpAxis sceneUp = UpAxis::Y;
  std::size_t triangles = 330'000;
  FigureFiles figures;
};

std::vector<std::string> setNames() {
  std::vector<std::string> names;
  for (const MotionSetKind& kind : kMotionSets) names.emplace_back(kind.name);
  return names;
}

Result<Done> complete(PeersRequest& request) {
  for (const std::string& output : {request.figures.json, request.figures.csv}) {
    FORETOUCH_CHECK(checkIsNoInput(output, {request.scenePath}));
  }
  for (const MotionSetKind& kind : kMotionSets) {
    if (isAsked(request.sets, kind.name)) request.plan.sets.push_back(kind);
  }
  if (!request.scenePath.empty()) return Done{};
  FORETOUCH_TRY(const auto folder, exampleFolder());
  request.scenePath = folder + "/room.obj";
  return Done{};
}

Result<Scene> loadScene(const PeersRequest& request) {
  FORETOUCH_TRY(auto imported,
                importScene(request.scenePath, importOf(request.sceneScale, request.sceneUp)));
  auto scene = Scene::build(subdivided(std::move(imported.scene), request.triangles));
  if (!scene.ok()) return inFile(scene.error(), request.scenePath);
  return scene;
}

BenchReport reportOf(const PeersRequest& request, const Scene& scene,
                     const std::vector<ComparedSet>& sets) {
  BenchReport report =
      startedReport("peers", "Foretouch and its peers: motions of one link in one scene");
  report.workload = {
      {"scene", fmt::format("{}, {} triangles", fileName(request.scenePath), scene.numTriangles())},
      {"motions a set", fmt::format("{}", request.plan.motions)},
      {"seed", fmt::format("{}", request.plan.seed)},
      {"rounds of Foretouch", fmt::format("{}", request.plan.rounds.own)},
      {"rounds of peers", fmt::format("{}", request.plan.rounds.peers)},
      {"peers", builtInPeers()}};
  report.tables = peerTables(sets);
  report.notes = peerNotes(sets);
  return report;
}

ExitCode run(PeersRequest& request) {
  if (!hasPeers()) {
    printError(
        "bench peers: this program was built without FCL and Bullet; install libfcl-dev and "
        "libbullet-dev and build again with -DFORETOUCH_PEERS=ON");
    return ExitCode::BadInput;
  }
  FORETOUCH_CHECK_OR(failed, complete(request));
  FORETOUCH_TRY_OR(failed, const auto scene, loadScene(request));
  std::unique_ptr<ProgressBar> bar;
  const auto sets = comparePeers(scene, request.plan, [&](std::int64_t done, std::int64_t total) {
    if (!bar) bar = std::make_unique<ProgressBar>("peers", total);
    bar->advanceTo(done);
  });
  bar.reset();
  if (!sets.ok()) return failed(inFile(sets.error(), request.scenePath));
  const std::size_t broken = brokenPromises(sets.value());
  return finished(
      reportOf(request, scene, sets.value()), rawPeerTable(sets.value()), request.figures,
      broken == 0 ? "" : fmt::format("Foretouch missed or reported late {} contacts", broken));
}

Settings settingsOf(PeersRequest& request) {
  Settings settings;
  settings.path("--scene", "FILE", request.scenePath, "Scene instead of the bundled room");
  settings.number("--scene-scale", "M", request.sceneScale, kMetresPerUnit,
                  "Metres per unit of the scene");
  settings
      .word("--scene-up", "y|z", request.sceneUp, {{"y", UpAxis::Y}, {"z", UpAxis::Z}},
            "Which axis of the scene is up")
      .formerly("--up");
  settings.whole("--triangles", "N", request.triangles, 1, kMostTriangles,
                 "Split the scene's longest edges until it has so many");
  addWords(settings, "--sets", "NAME,...", request.sets, setNames(),
           "Sets of motions; all if not given: S1 a forearm that moves and turns, S2 one that only "
           "moves, S5 a finger that moves and turns");
  settings.whole("--motions", "N", request.plan.motions, 1, kMostMotions,
                 "Motions of a set, half of them colliding");
  settings.whole("--seed", "S", request.plan.seed, 0, std::numeric_limits<std::int64_t>::max(),
                 "Of the motions");
  settings.whole("--rounds", "N", request.plan.rounds.own, 1, kMostRounds,
                 "Rounds of Foretouch; a motion's median time counts");
  settings.whole("--peer-rounds", "N", request.plan.rounds.peers, 1, kMostRounds,
                 "The same of the peers, which are slower");
  addFigures(settings, request.figures, "Also write every motion and solver to a file");
  return settings;
}

}  // namespace

Command peersCommand() {
  const auto request = std::make_shared<PeersRequest>();
  Command command{
      "peers",
      "Foretouch beside FCL and Bullet on the same motions; exit code 1 where Foretouch misses a "
      "contact or reports it late",
      "Takes a few minutes.\nExample:\n  foretouch-bench peers --json peers.json --csv peers.csv",
      settingsOf(*request)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
