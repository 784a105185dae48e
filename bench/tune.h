// bench/tune.h: `foretouch-bench tune`: finds, by trial, the settings that suit a user's own scene,
// avatar and clip within a time per step.
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
  Placement placement;           ///< The clip's in the scene.
  double budgetUs = 20.0;        ///< Time of a step, at the 99th percentile.
  std::optional<double> rateHz;  ///< None: kTuneRatesHz, as far as the clip has them.
  std::size_t steps = 400;       ///< For each rate at most, from the clip's beginning.
  int passes = 3;
  FigureFiles figures;  ///< Without lines for a CSV.
};

inline constexpr double kTuneRatesHz[] = {5.0, 10.0, 30.0, 60.0};
inline constexpr double kTuneTolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

/// One tried setting.
struct TunedSetting {
  Fidelity fidelity = Fidelity::Link;
  double tolerance = 1e-3, rateHz = 5.0;
  TradeRow row;
  std::int64_t posesMissed = 0;  ///< By checks of the poses alone, at the same rate.
};

/// A setting within the budget or, if none is, one of the quickest.
struct Recommendation {
  std::size_t setting = 0;  ///< Index among the tried ones.
  bool isWithinBudget = false;
};

/// Chooses among the settings of one rate. Never recommends one that missed something or was late.
/// Among the others within the budget at the 99th percentile (if none is: within a quarter of the
/// quickest), takes the one with the fewest false contacts, then the finest fidelity, then the
/// finest tolerance. None: it tried nothing, or all missed something.
[[nodiscard]] std::optional<Recommendation> recommended(const std::vector<TunedSetting>& settings,
                                                        double budgetUs);

/// The trials at one rate, and their results.
struct TunedRate {
  double rateHz = 0.0;   ///< As asked.
  double takenHz = 0.0;  ///< Poses per second that a whole number of frames gives.
  std::vector<TunedSetting> settings;
  std::optional<Recommendation> recommendation;
};

struct Tuned {
  std::vector<TunedRate> rates;
  BenchReport report;
};

/// Tries link fidelity, and exact if the avatar has meshes, at every tolerance. Errors name the
/// file or option.
[[nodiscard]] Result<Tuned> tune(const TuneRequest& request);

/// The recommendation in words, with the options that set it.
[[nodiscard]] std::string recommendationText(const TunedRate& rate, double budgetUs);

}  // namespace foretouch::tools
