// bench/deadline.h: `foretouch-bench deadline`: queries with a limited cost: how much of the answer
// is ready in time, how far they overrun, and whether their claims are true.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/result.h"
#include "bench/options.h"
#include "bench/report.h"

namespace foretouch::tools {

struct DeadlineRequest {
  BenchOptions options;
  double tolerance = 1e-3;
  int links = 0;              ///< 0: the avatar's own.
  std::size_t triangles = 0;  ///< 0: the scene's own.
  std::vector<double> deadlinesUs;
  std::vector<int> workBudgets;
  std::int64_t asks = 100'000;  ///< For each of them, at least; whole passes over the steps.
};

/// Compares every answer with the same step's touch: the scalar form at kTouchTolerance. A
/// violation claims to be free beyond the touch. One thread.
[[nodiscard]] Result<JudgedReport> measureDeadlines(const DeadlineRequest& request);

/// What counts as touching when an answer is judged (m).
inline constexpr double kTouchTolerance = 1e-7;
/// A share of the step: a touch this much later than at kTouchTolerance counts as the same.
inline constexpr double kTouchTime = 1e-6;

/// The false claims of `answer` against `touch`: the number of links claimed free beyond their
/// touch.
[[nodiscard]] std::int64_t unsoundLinks(const StepContacts& answer, const StepContacts& touch);

}  // namespace foretouch::tools
