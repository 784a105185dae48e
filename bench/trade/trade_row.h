// bench/trade/trade_row.h: the measurements of one strategy with one setting, and the settings that
// nothing beats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/timing.h"
#include "bench/trade/strategy.h"
#include "bench/trade/truth.h"

namespace foretouch::tools {

/// Links of all steps, and how far the reports are from the truth. Counts links that start in
/// contact separately: every strategy finds those.
struct TradeScore {
  std::int64_t steps = 0;
  std::int64_t contacts = 0;  ///< Links that touch after t = 0, beyond doubt.
  std::int64_t starts = 0;
  std::int64_t missed = 0;     ///< Contacts and starts that were not reported.
  std::int64_t falseOnes = 0;  ///< Reported, but never nearer than the tolerance.
  std::int64_t late = 0;       ///< Reported, but beyond doubt after it had touched.
  double lateMaxMs = 0.0;
  double toiErrorMeanMs = 0.0, toiErrorMaxMs = 0.0;  ///< For found contacts.
  /// Distance from touching at the reported instant, for all reports but starts (m).
  double distanceErrorMean = 0.0, distanceErrorMax = 0.0;
};

/// Sums a strategy's answers up.
class TradeScorer {
 public:
  explicit TradeScorer(double stepMs) : stepMs_(stepMs) {}
  /// Adds one step: the reports, the truth, and which links come nearer than the tolerance.
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
  TradeWork work;           ///< For all steps.
  bool onFrontier = false;  ///< On that of its scene, clip and rate.
};

/// Pointers to some of the rows, which must outlive them.
using TradeRows = std::vector<const TradeRow*>;
/// The names of their strategies, each once, in order of appearance.
[[nodiscard]] std::vector<std::string> strategiesOf(const TradeRows& rows);

/// One choice: its cost, its error, and whether it is safe.
struct TradeChoice {
  double cost = 0.0, error = 0.0;
  bool isSafe = true;
};
/// The choices that nothing beats: safe, and no other safe one is better in one and not worse in
/// the other. The first of equal ones. O(n^2).
[[nodiscard]] std::vector<bool> frontierOf(const std::vector<TradeChoice>& choices);

/// Marks the rows on the frontier of their scene, clip and rate: mean microseconds against the mean
/// distance from touching, among those that missed nothing and were never late.
void markFrontier(std::vector<TradeRow>& rows);

}  // namespace foretouch::tools
