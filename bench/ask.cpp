// bench/ask.cpp: `foretouch-bench ask`: what questions to a world at an instant cost, beside
// Embree's rays, and what a server's other ways to look at the past miss and invent.
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "articulated/try.h"
#include "bench/ask/clearances.h"
#include "bench/ask/player_shots.h"
#include "bench/ask/ray_crowd.h"
#include "bench/ask/ray_scene.h"
#include "bench/ask/shots.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/report.h"
#include "bench/world/people.h"
#include "tools/settings/lists.h"

namespace foretouch::tools {
namespace {

constexpr const char* kAskParts[] = {"clearances", "crowd", "players", "scene", "shots"};

struct AskBenchRequest {
  std::string dataFolder;          ///< With mocap/; without clips in it, the bundled dancer.
  std::vector<std::string> clips;  ///< Names or paths; empty: six.
  std::vector<std::string> parts;  ///< Some of kAskParts; empty: all.
  std::vector<int> avatars{1, 10, 100, 1000};
  int questions = 5000;     ///< For each kind.
  int shots = 2000;         ///< Per row.
  int triangles = 300'000;  ///< In the scene of rays.
  std::uint64_t seed = 1;
  FigureFiles figures;
};

/// One thread. Errors name a file, or the part of the input.
Result<JudgedReport> measureAsk(const AskBenchRequest& request) {
  FORETOUCH_TRY(const auto cast, loadActors(request.dataFolder, request.clips));
  if (clipPosesOf(cast, kShotRateHz).size() < cast.actors.size()) {
    return Error::in("--clips", ErrorCode::Empty, "expected clips of half a second or more");
  }
  JudgedReport bench{startedReport("ask", "Questions to a world at an instant")};
  BenchReport& report = bench.report;
  report.workload = {{"clips", namesOf(cast)}};
  if (isAsked(request.parts, "crowd")) {
    report.tables.push_back(rayCrowdTable(cast, request.avatars, request.questions, request.seed));
  }
  if (isAsked(request.parts, "players")) {
    bench.add(playersTable(cast, request.questions, request.seed));
  }
  if (isAsked(request.parts, "scene")) {
    FORETOUCH_TRY(auto table, raySceneTable(request.triangles, request.questions, request.seed));
    report.tables.push_back(std::move(table));
  }
  if (isAsked(request.parts, "clearances")) {
    FORETOUCH_TRY(auto table, clearancesTable(request.dataFolder, request.triangles,
                                              request.questions, request.seed));
    bench.add(std::move(table));
  }
  if (isAsked(request.parts, "shots")) {
    bench.add(shotsTable(cast, request.shots, request.seed));
  }
  report.notes = {
      "One thread. Each question is timed by itself; what reading the clock takes is subtracted. "
      "crowd: people 5 m apart, poses at 60 Hz, of one second; a ray is aimed at somebody from 5 "
      "to "
      "60 m away. One instant: all questions at the same instant between two poses. Own instants: "
      "each at another one of the second. Own instants of bodies: each body at another one, too.",
      "clearances: edges between free configurations, as one list on one thread, by that thread's "
      "time; judged at 64 instants by kinematics and distances of the judge's own.",
      "players: what the world takes per second of poses, by the heap's own count; the replay is a "
      "second world of the same poses.",
      "shots: a person goes through a clip and runs 3 m/s, captured 120 times per second; the "
      "truth "
      "is the in-between motion of these poses at the instant that the shooter saw, by the judge. "
      "A world has these poses. The other ways have a snapshot per tick. Missed: the truth hits. "
      "Invented: it does not. Latency: of the shooter, beside two ticks of interpolation."};
  return bench;
}

ExitCode run(const AskBenchRequest& request) {
  FORETOUCH_TRY_OR(failed, const auto bench, measureAsk(request));
  return finished(bench, "answers are not the judge's", request.figures);
}

}  // namespace

Command askBenchCommand() {
  constexpr int kMostAvatars = 10'000, kMost = 10'000'000, kMostSeed = 1'000'000'000;
  const auto asked = std::make_shared<AskBenchRequest>();
  AskBenchRequest& request = *asked;
  Settings settings;
  addData(settings, request.dataFolder, "With mocap/; $FORETOUCH_DATA says another");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths; six if not given, or the bundled dancer where these are absent");
  addWords(settings, "--parts", "NAME,...", request.parts,
           {std::begin(kAskParts), std::end(kAskParts)},
           "clearances (of a robot's edges), crowd, players (of a server), scene (beside Embree), "
           "shots (at who is seen late); all if "
           "not given");
  addCounts(settings, "--avatars", "N,...", request.avatars, kMostAvatars, "Of each crowd");
  settings.whole("--questions", "N", request.questions, 1, kMost, "Of each kind");
  settings.whole("--shots", "N", request.shots, 1, kMost, "Per row");
  settings.whole("--triangles", "N", request.triangles, 1, kMost,
                 "Of the room of rays and of clearances");
  settings.whole("--seed", "N", request.seed, 1, kMostSeed, "Of the questions");
  addFigures(settings, request.figures, "Also write the first table to a file");
  Command command{
      "ask", "What questions to a world cost, and what other ways to look at the past miss",
      "Example:\n  foretouch-bench ask --parts shots --shots 1000", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
