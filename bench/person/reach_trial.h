// bench/person/reach_trial.h: how long before a touch a hand that reaches for a table is warned, by
// what is said about its way, and by how near it is. Metres, seconds.
#pragma once

#include <cstdint>

#include "bench/report.h"

namespace foretouch::tools {

/// Arms that lean and reach with the least jerk: half of them touch the table, some end above it,
/// some go along it.
struct ReachRequest {
  int reaches = 200;
  double rateHz = 90.0;  ///< The rate of given poses.
  double speed = 1.0;    ///< A hand tip's greatest, give or take a fifth (m/s).
  std::uint64_t seed = 1;
};

/// Warns if a touch is possible within a time; beside it, if the hand is nearer than a distance
/// that gives as many false warnings. Violations: a touch came before it was possible.
[[nodiscard]] JudgedTable reachTable(const ReachRequest& request);

}  // namespace foretouch::tools
