// bench/ask/ray_crowd.h: what a question to a crowd costs, now and in the past.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

[[nodiscard]] BenchTable rayCrowdTable(const Cast& cast, const std::vector<int>& avatars,
                                       int questions, std::uint64_t seed);

}  // namespace foretouch::tools
