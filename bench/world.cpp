#include "bench/world.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/world/crowd.h"
#include "bench/world/exact.h"
#include "bench/world/following.h"
#include "bench/world/pairs.h"
#include "bench/world/people.h"
#include "bench/world/props.h"
#include "bench/world/ticking.h"
#include "bench/world/timed_world.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

using PartTable = std::function<BenchTable()>;

/// The judge looks at each triangle of a ring.
constexpr int kCapsulesPerRing = 10;

}  // namespace

Result<WorldBench> measureWorld(const WorldBenchRequest& request) {
  FORETOUCH_TRY(const auto cast, loadWorldCast(request.dataFolder, request.clips));
  if (clipPosesOf(cast, 5.0).size() < cast.actors.size()) {
    return Error::in("--clips", ErrorCode::Empty, "expected clips of half a second or more");
  }
  WorldBench bench;
  BenchReport& report = bench.report;
  report.kind = "world";
  report.title = "A moving world: everything that moves may touch everything else";
  report.command = request.command;
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = {{"tolerance", fmt::format("{:g} m", kBenchWorldTolerance)},
                     {"clips", namesOf(cast)}};
  const auto judged = [&bench](auto table) {
    bench.violations += table.violations;
    return std::move(table.table);
  };
  const std::pair<const char*, PartTable> parts[] = {
      {"crowd", [&] { return crowdTable(cast, request.avatars); }},
      {"self", [&] { return selfTable(cast); }},
      {"clocks", [&] { return clocksTable(cast); }},
      {"platform", [&] { return platformTable(cast); }},
      {"prop", [&] { return propTable(cast); }},
      {"exact", [&] { return exactTable(cast); }},
      {"pairs",
       [&] { return judged(pairsTable(PairKind::Capsules, request.pairs, request.seed)); }},
      {"pairs",
       [&] {
         const int rings = std::max(2, request.pairs / kCapsulesPerRing);
         return judged(pairsTable(PairKind::RingAndCapsule, rings, request.seed));
       }},
      {"ticking", [&] { return judged(tickingTable(cast, request.tickingWindows)); }},
      {"events", [&] { return judged(eventsTable(cast, request.tickingWindows)); }},
      {"following", [&] { return followingTable(cast); }}};
  ProgressBar progress("world", std::size(parts));
  std::int64_t done = 0;
  for (const auto& [name, table] : parts) {
    const auto& asked = request.parts;
    if (asked.empty() || std::find(asked.begin(), asked.end(), name) != asked.end()) {
      report.tables.push_back(table());
    }
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

}  // namespace foretouch::tools
