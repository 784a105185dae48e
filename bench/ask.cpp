#include "bench/ask.h"

#include <algorithm>
#include <iterator>

#include "articulated/try.h"
#include "bench/ask/player_shots.h"
#include "bench/ask/ray_crowd.h"
#include "bench/ask/ray_scene.h"
#include "bench/ask/shots.h"
#include "bench/machine.h"
#include "bench/world/people.h"

namespace foretouch::tools {
namespace {

bool isAsked(const AskBenchRequest& request, const std::string& part) {
  const auto& parts = request.parts;
  return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
}

}  // namespace

Result<AskBench> measureAsk(const AskBenchRequest& request) {
  FORETOUCH_TRY(const auto cast, loadWorldCast(request.dataFolder, request.clips));
  if (clipPosesOf(cast, kShotRateHz).size() < cast.actors.size()) {
    return Error::in("--clips", ErrorCode::Empty, "expected clips of half a second or more");
  }
  AskBench bench;
  BenchReport& report = bench.report;
  report.kind = "ask";
  report.title = "Questions to a world at an instant";
  report.command = request.command;
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = {{"clips", namesOf(cast)}};
  if (isAsked(request, "crowd")) {
    report.tables.push_back(rayCrowdTable(cast, request.avatars, request.questions, request.seed));
  }
  if (isAsked(request, "players")) {
    auto players = playersTable(cast, request.questions, request.seed);
    bench.violations += players.violations;
    report.tables.push_back(std::move(players.table));
  }
  if (isAsked(request, "scene")) {
    FORETOUCH_TRY(auto table, raySceneTable(request.triangles, request.questions, request.seed));
    report.tables.push_back(std::move(table));
  }
  if (isAsked(request, "shots")) {
    auto shots = shotsTable(cast, request.shots, request.seed);
    bench.violations += shots.violations;
    report.tables.push_back(std::move(shots.table));
  }
  report.notes = {
      "One thread. Each question is timed by itself; what reading the clock takes is subtracted. "
      "crowd: people 5 m apart, poses at 60 Hz, of one second; a ray is aimed at somebody from 5 "
      "to "
      "60 m away. One instant: all questions at the same instant between two poses. Own instants: "
      "each at another one of the second. Own instants of bodies: each body at another one, too.",
      "players: what the world takes per second of poses, by the heap's own count; the replay is a "
      "second world of the same poses.",
      "shots: a person goes through a clip and runs 3 m/s, captured 120 times per second; the "
      "truth "
      "is the in-between motion of these poses at the instant that the shooter saw, by the judge. "
      "A world has these poses. The other ways have a snapshot per tick. Missed: the truth hits. "
      "Invented: it does not. Latency: of the shooter, beside two ticks of interpolation."};
  return bench;
}

}  // namespace foretouch::tools
