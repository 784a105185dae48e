// bench/person/reach_trial.h: how long before a touch a hand is warned that reaches for a table, by
// what is said of its way, and by how near it is. Metres, seconds.
#pragma once

#include <cstdint>

#include "bench/report.h"

namespace foretouch::tools {

/// Arms that lean and reach with the least jerk: half of them touch the table, some end above it,
/// some go along it.
struct ReachRequest {
  int reaches = 200;
  double rateHz = 90.0;  ///< Of given poses.
  double speed = 1.0;    ///< The greatest of a hand's tip, give or take a fifth (m/s).
  std::uint64_t seed = 1;
};

/// Warned is who may touch within a time; beside it, who is nearer than a distance that warns as
/// many of those who do not touch. Violations: a touch came before it was possible.
[[nodiscard]] JudgedTable reachTable(const ReachRequest& request);

}  // namespace foretouch::tools
