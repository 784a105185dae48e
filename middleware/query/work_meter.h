// middleware/query/work_meter.h: how much of its budget a query has spent. Not installed.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

#include "middleware/query_counters.h"
#include "middleware/query_options.h"

namespace foretouch::internal {

/// Counts work in units of one evaluation of a pair in lanes, about ten nanoseconds, and reads the
/// clock if there is a deadline. It counts work, not time: the same query spends the same.
class WorkMeter {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  explicit WorkMeter(const QueryOptions& options)
      : limit_(options.workBudget), local_(options.workBudget) {
    if (options.deadlineUs < kLongestDeadlineUs) {
      hasDeadline_ = true;
      deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double, std::micro>(options.deadlineUs));
    }
  }

  [[nodiscard]] bool isLimited() const { return limit_ != kUnlimited || hasDeadline_; }
  /// Of the whole query.
  [[nodiscard]] bool isSpent(const QueryCounters& counters) const {
    return isOver(counters, limit_);
  }
  /// Of the current part, which ends no later than the whole.
  [[nodiscard]] bool isPartSpent(const QueryCounters& counters) const {
    return isOver(counters, local_);
  }
  /// Begins a part that may cost `work` from now on.
  void beginPart(const QueryCounters& counters, std::uint64_t work) {
    const std::uint64_t done = workOf(counters);
    local_ = work >= limit_ - std::min(done, limit_) ? limit_ : done + work;
  }
  /// Work left of the whole; 0 once it is spent.
  [[nodiscard]] std::uint64_t left(const QueryCounters& counters) const {
    return limit_ - std::min(workOf(counters), limit_);
  }

  /// Weights as measured, roughly. It matters only that no costly work is free.
  [[nodiscard]] static std::uint64_t workOf(const QueryCounters& c) {
    constexpr std::uint64_t kState = 2, kPart = 4, kPlane = 10, kAdvancement = 40, kCubic = 40;
    return c.nodes + c.leaves + c.clusterSteps + c.laneSteps + kState * c.states +
           kPart * c.partSteps + kPlane * c.planeTests + kAdvancement * c.advancements +
           kCubic * c.cubicTests;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLongestDeadlineUs = 1e12;  // beyond it there is none: no overflow

  [[nodiscard]] bool isOver(const QueryCounters& counters, std::uint64_t limit) const {
    if (limit != kUnlimited && workOf(counters) >= limit) return true;
    return hasDeadline_ && Clock::now() >= deadline_;
  }

  std::uint64_t limit_, local_;  // local_ <= limit_
  bool hasDeadline_ = false;
  Clock::time_point deadline_{};
};

}  // namespace foretouch::internal
