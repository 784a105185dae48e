// bench/world/following.h: what a world reports from enter to leave, beside a game that looks 90
// times per second at the newest sample of each body, and beside the truth; and what following
// costs.
#pragma once

#include <cstdint>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// Enters and leaves of meetings (meeting.h) of 0.8 s, as many as fill `windows` of 0.2 s.
[[nodiscard]] JudgedTable eventsTable(const Cast& cast, int windows);

/// Crowds that touch, and crowds without touches: what following costs beside asking for
/// first contacts, and how many distances it takes for each interval of contact.
[[nodiscard]] BenchTable followingTable(const Cast& cast);

}  // namespace foretouch::tools
