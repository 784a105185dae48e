// bench/world/crowd.h: what a crowd costs, and what own links, different clocks and a platform that
// moves add to it.
#pragma once

#include <vector>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// One person per so many metres, squared.
inline constexpr double kCrowdSpacing = 1.5;

/// Crowds at 30 Hz that ask own links and each other.
[[nodiscard]] BenchTable crowdTable(const Cast& cast, const std::vector<int>& counts);
/// The same crowd by one clock, and by a clock for each person.
[[nodiscard]] BenchTable clocksTable(const Cast& cast);
/// People on a platform: it stands still; it moves and carries them, with poses in its frame; it
/// moves and their poses are in the world.
[[nodiscard]] BenchTable platformTable(const Cast& cast);
/// One person alone, with and without own links.
[[nodiscard]] BenchTable selfTable(const Cast& cast);

}  // namespace foretouch::tools
