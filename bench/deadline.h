// bench/deadline.h: `foretouch-bench deadline`: queries that may cost only so much: how much
// of the answer is there in time, by how much they overrun, and that what they claim is true.
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
  std::int64_t asks = 100'000;  ///< Of each of them, at least; whole passes over the steps.
};

struct DeadlineBench {
  BenchReport report;
  std::int64_t unsound = 0;  ///< Answers that claimed to be free beyond the touch.
};

/// Every answer is held against the same step's touch: the scalar form at kTouchTolerance. One
/// thread.
[[nodiscard]] Result<DeadlineBench> measureDeadlines(const DeadlineRequest& request);

/// Metres: what counts as touching when an answer is judged.
inline constexpr double kTouchTolerance = 1e-7;
/// Of the step: how much later than at kTouchTolerance a touch may be without being told apart.
inline constexpr double kTouchTime = 1e-6;

/// What of `answer` is not true where the links touch as `touch` says: links that are said to be
/// free beyond it.
[[nodiscard]] std::int64_t unsoundLinks(const StepContacts& answer, const StepContacts& touch);

}  // namespace foretouch::tools
