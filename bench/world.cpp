// bench/world.cpp: `foretouch-bench world`: what a moving world costs, by itself and beside others'
// ways, and whether it keeps its promise where the truth is known.
#include <algorithm>
#include <cstdint>
#include <functional>
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
#include "bench/world/crowd.h"
#include "bench/world/exact.h"
#include "bench/world/following.h"
#include "bench/world/pairs.h"
#include "bench/world/people.h"
#include "bench/world/props.h"
#include "bench/world/ticking.h"
#include "bench/world/timed_world.h"
#include "tools/progress.h"
#include "tools/settings/lists.h"

namespace foretouch::tools {
namespace {

constexpr const char* kWorldParts[] = {"crowd", "self",  "clocks",  "platform", "prop",
                                       "exact", "pairs", "ticking", "events",   "following"};

struct WorldBenchRequest {
  std::string dataFolder;          ///< With mocap/; without clips in it, the bundled dancer.
  std::vector<std::string> clips;  ///< Names or paths; empty: six.
  std::vector<std::string> parts;  ///< Some of kWorldParts; empty: all.
  std::vector<int> avatars{2, 10, 30, 100, 300, 1000, 3000};
  int pairs = 2000;          ///< Pairs of two capsules.
  int tickingWindows = 100;  ///< Windows with two people.
  std::uint64_t seed = 1;
  FigureFiles figures;
};

using PartTable = std::function<JudgedTable()>;

/// The judge looks at each triangle of a ring.
constexpr int kCapsulesPerRing = 10;

/// One thread. Errors name a file, or the part of the input.
Result<JudgedReport> measureWorld(const WorldBenchRequest& request) {
  FORETOUCH_TRY(const auto cast, loadActors(request.dataFolder, request.clips));
  if (clipPosesOf(cast, 5.0).size() < cast.actors.size()) {
    return Error::in("--clips", ErrorCode::Empty, "expected clips of half a second or more");
  }
  JudgedReport bench{
      startedReport("world", "A moving world: everything that moves may touch everything else")};
  BenchReport& report = bench.report;
  report.workload = {{"tolerance", fmt::format("{:g} m", kBenchWorldTolerance)},
                     {"clips", namesOf(cast)}};
  const std::pair<const char*, PartTable> parts[] = {
      {"crowd", [&] { return JudgedTable{crowdTable(cast, request.avatars)}; }},
      {"self", [&] { return JudgedTable{selfTable(cast)}; }},
      {"clocks", [&] { return JudgedTable{clocksTable(cast)}; }},
      {"platform", [&] { return JudgedTable{platformTable(cast)}; }},
      {"prop", [&] { return JudgedTable{propTable(cast)}; }},
      {"exact", [&] { return JudgedTable{exactTable(cast)}; }},
      {"pairs", [&] { return pairsTable(PairKind::Capsules, request.pairs, request.seed); }},
      {"pairs",
       [&] {
         const int rings = std::max(2, request.pairs / kCapsulesPerRing);
         return pairsTable(PairKind::RingAndCapsule, rings, request.seed);
       }},
      {"ticking", [&] { return tickingTable(cast, request.tickingWindows); }},
      {"events", [&] { return eventsTable(cast, request.tickingWindows); }},
      {"following", [&] { return JudgedTable{followingTable(cast)}; }}};
  ProgressBar progress("world", std::size(parts));
  std::int64_t done = 0;
  for (const auto& [name, table] : parts) {
    if (isAsked(request.parts, name)) bench.add(table());
    progress.advanceTo(++done);
  }
  report.notes = {
      "Microseconds of the thread's processor time. A window's answer holds the first contact of "
      "every pair of links that is asked; who touches on from window to window is told in each (go "
      "on).",
      "Invented by a world: the two come within its tolerance, and turn away. The judge looks at "
      "the separation of each; farther apart is a broken promise."};
  return bench;
}

ExitCode run(const WorldBenchRequest& request) {
  FORETOUCH_TRY_OR(failed, const auto bench, measureWorld(request));
  return finished(bench, "answers broke the promise", request.figures);
}

}  // namespace

Command worldBenchCommand() {
  constexpr int kMostAvatars = 10'000, kMostPairs = 10'000'000, kMostSeed = 1'000'000'000;
  const auto asked = std::make_shared<WorldBenchRequest>();
  WorldBenchRequest& request = *asked;
  Settings settings;
  addData(settings, request.dataFolder, "With mocap/; $FORETOUCH_DATA says another");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths; six if not given, or the bundled dancer where these are absent");
  addWords(settings, "--parts", "NAME,...", request.parts,
           {std::begin(kWorldParts), std::end(kWorldParts)},
           "crowd, self, clocks, platform, prop, exact, pairs (beside FCL and Bullet), ticking, "
           "events, following; all if not given");
  addCounts(settings, "--avatars", "N,...", request.avatars, kMostAvatars, "Of each crowd");
  settings.whole("--pairs", "N", request.pairs, 1, kMostPairs, "Of capsules that both move");
  settings.whole("--windows", "N", request.tickingWindows, 1, kMostPairs,
                 "Of 0.2 s, of two people beside a game that ticks");
  settings.whole("--seed", "N", request.seed, 1, kMostSeed, "Of the pairs");
  addFigures(settings, request.figures, "Also write the first table to a file");
  Command command{
      "world", "What a moving world costs, beside others; exit code 1 where it breaks a promise",
      "Example:\n  foretouch-bench world --parts crowd --avatars 1000", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
