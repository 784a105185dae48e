// bench/trade/runner.h: strategies run over the same steps in turns, timed and held against
// the truth.
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

/// Steps that follow one another: each begins where the one before it ended.
using TradeWindow = std::vector<StepPoses>;

/// A strategy at a tolerance, for a run.
struct TradeContender {
  std::unique_ptr<Strategy> strategy;
  double tolerance = 1e-3;
  bool isExact = false;  ///< Held against the truth of the surface, not of the links' LSS.
};

/// What is run, and how often.
struct TradeRun {
  std::string scene, clip;  ///< For the rows.
  double rateHz = 5.0;
  double stepMs = 200.0;  ///< Of a step.
  std::vector<TradeWindow> windows;
  int passes = 3;  ///< Over every window; of each step the least time counts.
  int judged = 0;  ///< Links that the judge is asked about.
};

struct TradeRunResult {
  std::vector<TradeRow> rows;  ///< One a contender.
  JudgedTruth judged;
};

/// One thread. Every contender goes through a whole window as a stream would bring it, and they
/// take turns window by window, so that drift of the machine hits all alike. Contenders keep what
/// they learnt. The first pass' answers are held against the truth; answers of the others are the
/// same. Precondition: at least one step.
[[nodiscard]] Result<TradeRunResult> runTrade(const TradeWorld& world,
                                              const std::optional<AvatarSurface>& surface,
                                              const TradeRun& run,
                                              std::vector<TradeContender>& contenders);

}  // namespace foretouch::tools
