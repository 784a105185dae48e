// bench/ask/player_shots.h: a server of a shooter: what a shot costs in time, and the past in
// memory.
#pragma once

#include <cstdint>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// A violation is a verdict that a second world of the same poses does not give.
/// Sixty players, 128 poses per second of each, one second of memory; each shot sees each player at
/// an instant of its own, 50 to 150 ms and two ticks ago.
[[nodiscard]] JudgedTable playersTable(const Cast& cast, int shots, std::uint64_t seed);

}  // namespace foretouch::tools
