#include <filesystem>
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
#include "tools/settings/lists.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/peers.h"
#include "bench/report.h"
#include "bench/scene.h"
#include "lss/index.h"
#include "tools/inputs/example_folder.h"
#include "tools/progress.h"
#include "tools/results_output.h"
#include "tools/settings/frame_settings.h"

namespace foretouch::tools {
namespace {

constexpr int kMostMotions = 1'000'000, kMostRounds = 1'000, kMostTriangles = 5'000'000;

struct PeersRequest {
  PeersPlan plan;
  std::vector<std::string> sets;  ///< Empty: all.
  std::string scenePath;
  double sceneScale = 1.0;
  UpAxis sceneUp = UpAxis::Y;
  std::size_t triangles = 330'000;
  std::string json, csv;
};

std::vector<std::string> setNames() {
  std::vector<std::string> names;
  for (const MotionSetKind& kind : kMotionSets) names.emplace_back(kind.name);
  return names;
}

Result<Done> complete(PeersRequest& request) {
  for (const std::string& output : {request.json, request.csv}) {
    FORETOUCH_CHECK(checkIsNoInput(output, {request.scenePath}));
  }
  const std::vector<std::string> names = request.sets.empty() ? setNames() : request.sets;
  for (const std::string& name : names) {
    for (const MotionSetKind& kind : kMotionSets) {
      if (name == kind.name) request.plan.sets.push_back(kind);
    }
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
  BenchReport report;
  report.kind = "peers";
  report.title = "Foretouch and its peers: motions of one link in one scene";
  report.command = ownCommandLine();
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = {
      {"scene",
       fmt::format("{}, {} triangles", std::filesystem::path(request.scenePath).filename().string(),
                   scene.numTriangles())},
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
  const BenchReport report = reportOf(request, scene, sets.value());
  FORETOUCH_CHECK_OR(failed,
                     writeReport(report, request.json, rawPeerTable(sets.value()), request.csv));
  printOut(reportText(report));
  const std::size_t broken = brokenPromises(sets.value());
  if (broken == 0) return ExitCode::Done;
  printError(fmt::format("Foretouch missed or reported late {} contacts", broken));
  return ExitCode::CheckSaysNo;
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
  addFigures(settings, request.json, request.csv, "Also write every motion and solver to a file");
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
