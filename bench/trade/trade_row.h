// bench/trade/trade_row.h: what was measured of one strategy with one setting, and which
// settings nothing beats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/timing.h"
#include "bench/trade/strategy.h"
#include "bench/trade/truth.h"

namespace foretouch::tools {

/// Links of all steps, and how far what was reported is from the truth. Links that start in contact
/// are counted by themselves: everybody finds those.
struct TradeScore {
  std::int64_t steps = 0;
  std::int64_t contacts = 0;  ///< Links that touch after t = 0, beyond doubt.
  std::int64_t starts = 0;
  std::int64_t missed = 0;     ///< Of contacts and starts: not reported.
  std::int64_t falseOnes = 0;  ///< Reported, but never nearer than the tolerance.
  std::int64_t late = 0;       ///< Reported, but beyond doubt after it had touched.
  double lateMaxMs = 0.0;
  double toiErrorMeanMs = 0.0, toiErrorMaxMs = 0.0;  ///< Of contacts that were found.
  /// From touching, at the reported instant, of all that was reported but starts (m).
  double distanceErrorMean = 0.0, distanceErrorMax = 0.0;
};

/// Sums a strategy's answers up.
class TradeScorer {
 public:
  explicit TradeScorer(double stepMs) : stepMs_(stepMs) {}
  /// One step: what was reported, the truth, and who comes nearer than the tolerance.
  void add(const StepPoses& step, const std::vector<LinkTouch>& touches,
           const std::vector<LinkTruth>& truths, const std::vector<bool>& within,
           TruthTeller& teller);
  [[nodiscard]] TradeScore score() const;

 private:
  void addLink(const LinkTouch& touch, const LinkTruth& truth, bool within);
  double stepMs_;
  TradeScore score_;
  double toiErrors_ = 0.0, distanceErrors_ = 0.0;
  std::int64_t found_ = 0, reported_ = 0;
};

struct TradeRow {
  std::string scene, clip, strategy;
  TradePromise promise = TradePromise::Nothing;
  double tolerance = 0.0, rateHz = 0.0;
  TradeScore score;
  Percentiles us;
  TradeWork work;           ///< Of all steps.
  bool onFrontier = false;  ///< Of its scene, clip and rate.
};

/// Some of the rows; whoever holds them holds the rows as well.
using TradeRows = std::vector<const TradeRow*>;
/// The names of their strategies, each once, in the order in which they come.
[[nodiscard]] std::vector<std::string> strategiesOf(const TradeRows& rows);

/// One choice: what it costs, how wrong it is, and whether it may be taken at all.
struct TradeChoice {
  double cost = 0.0, error = 0.0;
  bool isSafe = true;
};
/// Which of the choices nothing beats: safe, and no other safe one is better in one and not worse
/// in the other. Of equal ones the first. O(n^2).
[[nodiscard]] std::vector<bool> frontierOf(const std::vector<TradeChoice>& choices);

/// Marks the rows that are on the frontier of their scene, clip and rate: mean microseconds against
/// the mean distance from touching, of those that missed nothing and were never late.
void markFrontier(std::vector<TradeRow>& rows);

}  // namespace foretouch::tools
