// bench/world/ticking.h: what a game sees that looks 90 times per second at the newest sample of
// each body, beside a world, and beside the truth: two people, one of them tracked 30 times per
// second and the other one 90 times, walk through each other.
#pragma once

#include <cstdint>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// `windows` of 0.2 s. A sample is there for the game as soon as it is taken.
[[nodiscard]] JudgedTable tickingTable(const Cast& cast, int windows);

}  // namespace foretouch::tools
