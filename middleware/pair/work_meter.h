// middleware/pair/work_meter.h: how much of its budget a query has spent. Not installed.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

#include "middleware/contact.h"
#include "middleware/query_options.h"

namespace foretouch::internal {

/// Counts work in units of one evaluation of a pair in lanes, about ten nanoseconds, and reads the
/// clock if there is a deadline. It counts work, not time: the same query spends the same.
class WorkMeter {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  explicit WorkMeter(const QueryOptions& options) : whole_{options.workBudget, {}} {
    if (options.deadlineUs < kLongestDeadlineUs) {
      hasDeadline_ = true;
      begin_ = Clock::now();
      whole_.deadline = begin_ + microseconds(options.deadlineUs);
    }
    part_ = whole_;
  }

  /// Without a deadline.
  explicit WorkMeter(std::uint64_t work) : whole_{work, {}}, part_(whole_) {}

  [[nodiscard]] bool isLimited() const { return whole_.work != kUnlimited || hasDeadline_; }
  /// Whether the work of the whole query is spent.
  [[nodiscard]] bool isSpent(const QueryCounters& counters) const {
    return isOver(counters, whole_);
  }
  /// The same for the current part, which ends no later than the whole.
  [[nodiscard]] bool isPartSpent(const QueryCounters& counters) const {
    return isOver(counters, part_);
  }
  /// Begins a part that may cost `work` from now on.
  void beginPart(const QueryCounters& counters, std::uint64_t work) {
    part_ = whole_;
    const std::uint64_t done = workOf(counters);
    if (work < left(counters)) part_.work = done + work;
  }
  /// The part at hand, which the query begins with, may cost this share of the whole, or as much as
  /// `work` if that is more.
  void beginShare(double share, std::uint64_t work) {
    if (whole_.work != kUnlimited) {
      const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(whole_.work));
      part_.work = std::min(std::max(wanted, work), whole_.work);
    }
    const Clock::duration time = whole_.deadline - begin_;
    const auto wanted = std::chrono::duration_cast<Clock::duration>(share * time);
    const auto least = microseconds(kEvaluationUs * static_cast<double>(work));
    part_.deadline = begin_ + std::min(std::max(wanted, least), time);
  }
  /// Work left of the whole; 0 once it is spent.
  [[nodiscard]] std::uint64_t left(const QueryCounters& counters) const {
    return whole_.work - std::min(workOf(counters), whole_.work);
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

  struct Limit {
    std::uint64_t work;
    Clock::time_point deadline;
  };

  [[nodiscard]] static Clock::duration microseconds(double us) {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double, std::micro>(us));
  }
  [[nodiscard]] bool isOver(const QueryCounters& counters, const Limit& limit) const {
    if (limit.work != kUnlimited && workOf(counters) >= limit.work) return true;
    return hasDeadline_ && Clock::now() >= limit.deadline;
  }

  Limit whole_, part_;
  bool hasDeadline_ = false;
  Clock::time_point begin_{};
};

}  // namespace foretouch::internal
