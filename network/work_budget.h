// network/work_budget.h: a wish for time as an amount of work. The wall clock decides no verdict,
// so that a replay repeats it; what a query may spend is counted in distance evaluations.
#pragma once

#include <cstdint>

namespace foretouch {

/// One scalar distance evaluation of a link and a triangle, microseconds: measured on a 2.x GHz
/// server core and rounded up. Elsewhere a budget takes more or less time, but the same work.
inline constexpr double kEvaluationUs = 0.4;

/// Distance evaluations that each of `numLinks` links may cost (QueryOptions::maxAdvancements) so
/// that a pose is answered in about `budgetUs` even where all of them spend all of it; at least 1.
/// Precondition: budgetUs > 0 and finite, numLinks > 0.
[[nodiscard]] inline std::uint64_t workBudget(double budgetUs, std::int32_t numLinks) {
  constexpr double kMost = 1e15;  // beyond any query; a whole number as a double
  const double each = budgetUs / kEvaluationUs / numLinks;
  if (!(each > 1.0)) return 1;
  return static_cast<std::uint64_t>(each < kMost ? each : kMost);
}

}  // namespace foretouch
