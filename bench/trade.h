// bench/trade.h: `foretouch-bench trade`: the trade-off between speed and accuracy, over
// strategies, tolerances, rates, clips and scenes.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/inputs.h"
#include "bench/report.h"
#include "bench/trade/trade_row.h"
#include "bench/workload.h"

namespace foretouch::tools {

struct TradeRequest {
  std::vector<BenchFiles> worlds;  ///< Each a scene and a clip.
  std::vector<double> tolerances;  ///< Metres.
  std::vector<double> ratesHz;     ///< Skips those that a clip does not have.
  double baseTolerance = 1e-3;     ///< While varying the rate; one of the tolerances.
  double baseRateHz = 5.0;         ///< While varying the tolerance; one of the rates.
  double seconds = 4.0;            ///< Length of the clip's part at each place.
  int places = 3;                  ///< Places in each scene.
  int passes = 3;
  int judged = 40;  ///< Links per world.
  std::size_t surfaceTriangles = 20'000;
  WorkloadRequest workload;  ///< Seed, floor and lift count.
};

struct MeasuredTrade {
  std::vector<TradeRow> rows;
  BenchReport report;
};

/// Errors name the file or option.
[[nodiscard]] Result<MeasuredTrade> measureTrade(const TradeRequest& request);

}  // namespace foretouch::tools
