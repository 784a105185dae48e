// bench/ask/shots.h: shots at somebody who moves, whom the shooter sees late: what a server's ways
// to look at the past miss and invent.
#pragma once

#include <cstdint>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// Of the poses that are captured.
inline constexpr double kShotRateHz = 120.0;

struct ShotsTable {
  BenchTable table;
  std::uint64_t violations = 0;  ///< Verdicts or links of a world that are not the judge's.
};
/// So many shots per row; a row per tick rate and latency.
[[nodiscard]] ShotsTable shotsTable(const WorldCast& cast, int shots, std::uint64_t seed);

}  // namespace foretouch::tools
