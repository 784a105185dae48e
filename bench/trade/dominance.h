// bench/trade/dominance.h: by how much Foretouch is ahead of the strategies of others that
// missed nothing, or by how much it is not.
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
/// Nothing was missed, and nothing found late.
[[nodiscard]] bool isSafe(const TradeRow& row);
/// Both are of the same scene, clip and rate.
[[nodiscard]] bool isSameRun(const TradeRow& x, const TradeRow& y);

struct TradeDominance {
  /// Settings of others that were safe, where there was a contact to find.
  std::int64_t rivals = 0;
  /// Of them: some setting of Foretouch, safe as well, was both quicker and closer to touching.
  std::int64_t beaten = 0;
  /// A rival's mean time by Foretouch's with the same tolerance in the same run, of the rivals that
  /// promise contacts within the tolerance.
  std::vector<double> factors;  ///< Ascending.
};

/// O(n^2).
[[nodiscard]] TradeDominance dominanceOf(const std::vector<TradeRow>& rows);

/// "Of 887 settings of other strategies that missed nothing ...": a sentence or two.
[[nodiscard]] std::string dominanceText(const TradeDominance& dominance);

}  // namespace foretouch::tools
