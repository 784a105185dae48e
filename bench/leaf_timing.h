// bench/leaf_timing.h: the times of leaf queries, their answers and the stages that decided.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/query_set.h"
#include "tests/reference/leaf.h"

namespace foretouch::tools {

inline constexpr std::size_t kLeafStages = 2;

/// One query: the least time of all passes, less the cost of reading the clock.
struct TimedLeaf {
  double us = 0.0;
  LeafStage stage = LeafStage::Filter;
  bool hits = false;
  std::optional<bool> truth;
};

struct TimedSet {
  std::string name, kind;
  std::vector<TimedLeaf> leaves;
};

/// Runs every query once per pass, in `repeat` passes, so that no query runs right after itself: a
/// branch predictor that has just seen it would make it faster. `repeat` >= 1.
[[nodiscard]] std::vector<TimedLeaf> timeLeaves(std::size_t count, int repeat,
                                                const std::function<LeafAnswer(std::size_t)>& ask);

/// Microseconds between two readings of the clock with nothing in between, the least of many.
[[nodiscard]] double clockOverheadUs();

/// Mean, median, 99th percentile (nearest rank) and greatest; zeros if there are none.
struct TimeFigures {
  double meanUs = 0.0, medianUs = 0.0, p99Us = 0.0, maxUs = 0.0;
};
[[nodiscard]] TimeFigures figuresOf(std::vector<double> us);

/// Queries of one set whose right answer (or, unlabelled, whose answer) is the same.
struct LeafGroup {
  std::string name, kind;
  bool positive = false, labelled = false;
  std::size_t count = 0;
  std::size_t falseNegatives = 0, falsePositives = 0;
  TimeFigures time;
  std::array<std::size_t, kLeafStages> decided{};   ///< Queries that each stage decided.
  std::array<double, kLeafStages> decidedMeanUs{};  ///< Their mean time.
};

/// Two groups per set, positives first, without empty groups.
[[nodiscard]] std::vector<LeafGroup> groupsOf(const TimedSet& set);

/// All leaves of the sets for which `take` is true, by kind and then together.
[[nodiscard]] std::vector<TimedSet> joined(const std::vector<TimedSet>& sets,
                                           const std::string& name,
                                           const std::function<bool(const TimedSet&)>& take);

}  // namespace foretouch::tools
