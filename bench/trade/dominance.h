// bench/trade/dominance.h: how far Foretouch is ahead of other strategies that missed nothing, or
// behind them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/timing.h"
#include "bench/trade/trade_row.h"

namespace foretouch::tools {

/// The strategy that is the product's default: the links' LSS, in lanes.
inline constexpr char kForetouchStrategy[] = "Foretouch";
/// True for the default, the other rungs and the scalar form.
[[nodiscard]] bool isForetouch(const TradeRow& row);
/// Missed nothing, and found nothing late.
[[nodiscard]] bool isSafe(const TradeRow& row);
/// True if both are of the same scene, clip and rate.
[[nodiscard]] bool isSameRun(const TradeRow& x, const TradeRow& y);

struct TradeDominance {
  /// Safe settings of others, in runs with a contact to find.
  std::int64_t rivals = 0;
  /// Those for which some setting of Foretouch, also safe, was both quicker and closer to touching.
  std::int64_t beaten = 0;
  /// A rival's mean time divided by Foretouch's with the same tolerance in the same run, for the
  /// rivals that promise contacts within the tolerance.
  std::vector<double> factors;  ///< Ascending.
};

/// O(n^2).
[[nodiscard]] TradeDominance dominanceOf(const std::vector<TradeRow>& rows);

/// "Of 887 settings of other strategies that missed nothing ...": a sentence or two.
[[nodiscard]] std::string dominanceText(const TradeDominance& dominance);

}  // namespace foretouch::tools
