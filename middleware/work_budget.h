// middleware/work_budget.h: turns a time limit into an amount of work. A budget counts
// evaluations in lanes, so the wall clock decides no verdict and a replay repeats every one.
#pragma once

#include <cstdint>

namespace foretouch {

/// Microseconds per evaluation of a pair in lanes, or as much other work: about its time on a 2.x
/// GHz server core. On other machines a budget takes more or less time, but the same work.
inline constexpr double kEvaluationUs = 0.01;

/// QueryOptions::workBudget of a step that may take about `budgetUs`; at least 1.
/// Precondition: budgetUs > 0 and finite.
[[nodiscard]] inline std::uint64_t workBudget(double budgetUs) {
  constexpr double kMost = 1e15;  // beyond any query; a whole number as a double
  const double work = budgetUs / kEvaluationUs;
  if (!(work > 1.0)) return 1;
  return static_cast<std::uint64_t>(work < kMost ? work : kMost);
}

}  // namespace foretouch
