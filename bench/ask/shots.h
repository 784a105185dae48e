// bench/ask/shots.h: shots at a moving person, whom the shooter sees late: what a server's ways
// to look at the past miss and invent.
#pragma once

#include <cstdint>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// The rate of the captured poses.
inline constexpr double kShotRateHz = 120.0;

/// A violation is a verdict or link of a world that differs from the judge's.
/// So many shots per row; a row per tick rate and latency.
[[nodiscard]] JudgedTable shotsTable(const Cast& cast, int shots, std::uint64_t seed);

}  // namespace foretouch::tools
