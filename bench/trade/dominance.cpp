#include "bench/trade/dominance.h"

#include <algorithm>

#include <fmt/format.h>

namespace foretouch::tools {

bool isForetouch(const TradeRow& row) {
  return row.strategy.rfind(kForetouchStrategy, 0) == 0;
}

bool isSafe(const TradeRow& row) {
  return row.score.missed == 0 && row.score.late == 0;
}

bool isSameRun(const TradeRow& x, const TradeRow& y) {
  return x.rateHz == y.rateHz && x.scene == y.scene && x.clip == y.clip;
}

TradeDominance dominanceOf(const std::vector<TradeRow>& rows) {
  std::vector<const TradeRow*> ours;
  for (const TradeRow& row : rows) {
    if (row.strategy == kForetouchStrategy && isSafe(row)) ours.push_back(&row);
  }
  TradeDominance dominance;
  for (const TradeRow& rival : rows) {
    if (isForetouch(rival) || !isSafe(rival) || rival.score.contacts == 0) continue;
    ++dominance.rivals;
    bool isBeaten = false;
    for (const TradeRow* const own : ours) {
      if (!isSameRun(*own, rival)) continue;
      isBeaten = isBeaten || (own->us.mean < rival.us.mean &&
                              own->score.distanceErrorMean <= rival.score.distanceErrorMean);
      const bool isLike =
          own->tolerance == rival.tolerance && rival.promise == TradePromise::Accurate;
      if (isLike && own->us.mean > 0.0) dominance.factors.push_back(rival.us.mean / own->us.mean);
    }
    if (isBeaten) ++dominance.beaten;
  }
  std::sort(dominance.factors.begin(), dominance.factors.end());
  return dominance;
}

std::string dominanceText(const TradeDominance& dominance) {
  if (dominance.rivals == 0) return "No other strategy found every contact in time.";
  std::string text = fmt::format(
      "Other strategies found every contact in time with {} settings; {} of these {} beaten by a "
      "setting of Foretouch that is quicker and also closer to touching.",
      dominance.rivals,
      dominance.beaten == dominance.rivals ? "all" : fmt::format("{}", dominance.beaten),
      dominance.beaten == 1 ? "is" : "are");
  if (dominance.factors.empty()) return text;
  return text + fmt::format(
                    " With the same tolerance, Foretouch takes {:.1f} to {:.0f} times less time "
                    "than those that also keep it; half of the time {:.0f} times or more.",
                    dominance.factors.front(), dominance.factors.back(),
                    valueAtRank(dominance.factors, 0.5));
}

}  // namespace foretouch::tools
