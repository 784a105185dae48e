// bench/tune.h: `foretouch-bench tune`: which settings suit a user's own scene, avatar and clip,
// within a time a step, by trying them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/inputs.h"
#include "bench/report.h"
#include "bench/trade/trade_row.h"
#include "middleware/query/query.h"

namespace foretouch::tools {

struct TuneRequest {
  BenchFiles files;
  Placement placement;           ///< Of the clip in the scene.
  double budgetUs = 20.0;        ///< A step may take, at the 99th percentile.
  std::optional<double> rateHz;  ///< None: kTuneRatesHz, as far as the clip has them.
  std::size_t steps = 400;       ///< Tried at each rate at most, from the clip's beginning.
  int passes = 3;
  std::string command;  ///< As typed in.
};

inline constexpr double kTuneRatesHz[] = {5.0, 10.0, 30.0, 60.0};
inline constexpr double kTuneTolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

/// One setting that was tried.
struct TunedSetting {
  Fidelity fidelity = Fidelity::Link;
  double tolerance = 1e-3, rateHz = 5.0;
  TradeRow row;
  std::int64_t posesMissed = 0;  ///< By looking at the poses alone, at the same rate.
};

/// A setting within the budget, or one that is as quick as any where none is.
struct Recommendation {
  std::size_t setting = 0;  ///< Of those that were tried.
  bool isWithinBudget = false;
};

/// Of settings of one rate. Those that missed something or were late are never recommended; of the
/// others those within the budget at the 99th percentile (where none is: within a quarter of the
/// quickest): with the fewest false contacts, then the finest fidelity, then the finest tolerance.
/// None: nothing was tried, or all missed something.
[[nodiscard]] std::optional<Recommendation> recommended(const std::vector<TunedSetting>& settings,
                                                        double budgetUs);

/// What was tried at one rate, and what came of it.
struct TunedRate {
  double rateHz = 0.0;
  std::vector<TunedSetting> settings;
  std::optional<Recommendation> recommendation;
};

struct Tuned {
  std::vector<TunedRate> rates;
  BenchReport report;
};

/// Tries rungs from the coarsest to exact, where the avatar has meshes, at every tolerance.
/// Errors name the file or option.
[[nodiscard]] Result<Tuned> tune(const TuneRequest& request);

/// The recommendation in words, with the options that set it.
[[nodiscard]] std::string recommendationText(const TunedRate& rate, double budgetUs);

}  // namespace foretouch::tools
