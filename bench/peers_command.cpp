#include "bench/peers_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/import/scene_import.h"
#include "assets/text_file.h"
#include "bench/inputs.h"
#include "bench/machine.h"
#include "bench/peers.h"
#include "bench/report.h"
#include "bench/scene.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/inputs/example_folder.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

constexpr int kMostMotions = 1'000'000, kMostRounds = 1'000, kMostTriangles = 5'000'000;

struct PeersTexts {
  std::string scene, sceneScale = "1", up = "y", triangles = "330000";
  std::string motions = "1000", rounds = "3", peerRounds = "1";
  std::vector<std::string> sets;
  std::uint64_t seed = 1;
  std::string json, csv;
};

struct PeersRequest {
  PeersPlan plan;
  std::string scenePath;
  SceneImportOptions import;
  std::size_t triangles = 0;
};

Result<std::vector<MotionSetKind>> setsNamed(const std::vector<std::string>& names) {
  if (names.empty()) return std::vector<MotionSetKind>(kMotionSets.begin(), kMotionSets.end());
  std::vector<MotionSetKind> kinds;
  for (const std::string& name : names) {
    const std::size_t before = kinds.size();
    for (const MotionSetKind& kind : kMotionSets) {
      if (name == kind.name) kinds.push_back(kind);
    }
    if (kinds.size() == before) {
      return Error::in("--sets", ErrorCode::UnknownName,
                       "expected S1, S2 or S5, found " + inQuotes(name));
    }
  }
  return kinds;
}

Result<Done> parseScene(const PeersTexts& texts, PeersRequest& request) {
  FORETOUCH_TRY(const auto scale, parsePositive("--scene-scale", texts.sceneScale));
  FORETOUCH_TRY(const auto up, parseUpAxis("--scene-up", texts.up));
  FORETOUCH_TRY(const auto triangles, parseCount("--triangles", texts.triangles, kMostTriangles));
  request.import = importOf(scale, up);
  request.triangles = countOf(triangles);
  request.scenePath = texts.scene;
  if (!texts.scene.empty()) return Done{};
  FORETOUCH_TRY(const auto folder, exampleFolder());
  request.scenePath = folder + "/room.obj";
  return Done{};
}

Result<PeersRequest> parse(const PeersTexts& texts) {
  PeersRequest request;
  for (const std::string& output : {texts.json, texts.csv}) {
    FORETOUCH_CHECK(checkIsNoInput(output, {texts.scene}));
  }
  FORETOUCH_TRY(auto sets, setsNamed(texts.sets));
  FORETOUCH_TRY(const auto motions, parseCount("--motions", texts.motions, kMostMotions));
  const auto rounds = parseCount("--rounds", texts.rounds, kMostRounds);
  if (!rounds.ok()) return rounds.error();
  FORETOUCH_TRY(const auto peerRounds, parseCount("--peer-rounds", texts.peerRounds, kMostRounds));
  FORETOUCH_CHECK(parseScene(texts, request));
  request.plan = {
      std::move(sets), static_cast<std::size_t>(motions), texts.seed, {rounds.value(), peerRounds}};
  return request;
}

Result<Scene> loadScene(const PeersRequest& request) {
  FORETOUCH_TRY(auto imported, importScene(request.scenePath, request.import));
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

ExitCode run(const PeersTexts& texts) {
  if (!hasPeers()) {
    printError(
        "bench peers: this program was built without FCL and Bullet; install libfcl-dev and "
        "libbullet-dev and build again with -DFORETOUCH_PEERS=ON");
    return ExitCode::BadInput;
  }
  FORETOUCH_TRY_OR(failed, const auto request, parse(texts));
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
                     writeReport(report, texts.json, rawPeerTable(sets.value()), texts.csv));
  printOut(reportText(report));
  const std::size_t broken = brokenPromises(sets.value());
  if (broken == 0) return ExitCode::Done;
  printError(fmt::format("Foretouch missed or reported late {} contacts", broken));
  return ExitCode::CheckSaysNo;
}

void addOptions(CLI::App& command, PeersTexts& texts) {
  const auto option = [&](const char* name, std::string& value, const char* help,
                          const char* type) {
    command.add_option(name, value, help)->type_name(type)->capture_default_str();
  };
  option("--scene", texts.scene, "Scene instead of the bundled room", "FILE");
  option("--scene-scale", texts.sceneScale, "Metres per unit of the scene", "M");
  option("--scene-up,--up", texts.up, "Which axis of the scene is up: y or z", "AXIS");
  option("--triangles", texts.triangles, "Split the scene's longest edges until it has so many",
         "N");
  command
      .add_option("--sets", texts.sets,
                  "Sets of motions, default all: S1 a forearm that moves and turns, S2 one that "
                  "only moves, S5 a finger that moves and turns")
      ->type_name("NAME...");
  option("--motions", texts.motions, "Motions of a set, half of them colliding", "N");
  command.add_option("--seed", texts.seed, "Of the motions")->type_name("S")->capture_default_str();
  option("--rounds", texts.rounds, "Rounds of Foretouch; a motion's median time counts", "N");
  option("--peer-rounds", texts.peerRounds, "The same of the peers, which are slower", "N");
  option("--json", texts.json, "Also write the tables to a file", "FILE");
  option("--csv", texts.csv, "Also write every motion and solver to a file", "FILE");
}

}  // namespace

void addBenchPeersCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<PeersTexts>();
  CLI::App* const peers = bench.add_subcommand(
      "peers",
      "Foretouch beside FCL and Bullet on the same motions; exit code 1 where Foretouch misses a "
      "contact or reports it late");
  addOptions(*peers, *texts);
  peers->footer(
      "Takes a few minutes.\nExample:\n  foretouch-bench peers --json peers.json --csv peers.csv");
  peers->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
