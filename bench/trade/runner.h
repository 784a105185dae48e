// bench/trade/runner.h: runs strategies over the same steps in turns, times them and compares them
// with the truth.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/trade/strategies.h"
#include "bench/trade/trade_row.h"
#include "bench/trade/truth.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch::tools {

/// Consecutive steps: each begins where the one before it ended.
using TradeWindow = std::vector<StepPoses>;

/// A strategy at a tolerance, for a run.
struct TradeContender {
  std::unique_ptr<Strategy> strategy;
  double tolerance = 1e-3;
  bool isExact = false;  ///< Compared with the truth of the surface, not of the links' LSS.
};

/// A run, and its repetitions.
struct TradeRun {
  std::string scene, clip;  ///< For the rows.
  double rateHz = 5.0;
  double stepMs = 200.0;  ///< Length of a step.
  std::vector<TradeWindow> windows;
  int passes = 3;  ///< Over every window; each step's least time counts.
  int judged = 0;  ///< Links that the judge examines.
};

struct TradeRunResult {
  std::vector<TradeRow> rows;  ///< One per contender.
  JudgedTruth judged;
};

/// One thread. Every contender runs through a whole window like a stream, and they take turns
/// window by window, so that drift of the machine affects all alike. Contenders keep their state.
/// Compares the first pass's answers with the truth; the others' are the same. Precondition: at
/// least one step.
[[nodiscard]] Result<TradeRunResult> runTrade(const TradeWorld& world,
                                              const std::optional<AvatarSurface>& surface,
                                              const TradeRun& run,
                                              std::vector<TradeContender>& contenders);

}  // namespace foretouch::tools
