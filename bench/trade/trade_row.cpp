#include "bench/trade/trade_row.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"

namespace foretouch::tools {

void TradeScorer::add(const StepPoses& step, const std::vector<LinkTouch>& touches,
                      const std::vector<LinkTruth>& truths, const std::vector<bool>& within,
                      TruthTeller& teller) {
  FORETOUCH_ASSERT(touches.size() == truths.size() && within.size() == truths.size());
  ++score_.steps;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    addLink(touches[i], truths[i], within[i]);
    if (!touches[i].touches || truths[i].starts) continue;
    const double separation = teller.separationAt(step, static_cast<LinkId>(i), touches[i].toi);
    ++reported_;
    distanceErrors_ += std::abs(separation);
    score_.distanceErrorMax = std::max(score_.distanceErrorMax, std::abs(separation));
  }
}

void TradeScorer::addLink(const LinkTouch& touch, const LinkTruth& truth, bool within) {
  if (truth.starts) {
    ++score_.starts;
  } else if (truth.touches) {
    ++score_.contacts;
  }
  if (truth.touches && !touch.touches) ++score_.missed;
  if (!touch.touches) return;
  if (!within) ++score_.falseOnes;
  if (!truth.touches || truth.starts) return;
  const double lateMs = stepMs_ * (touch.toi - truth.touchesBy);
  if (lateMs > 0.0) ++score_.late;
  score_.lateMaxMs = std::max(score_.lateMaxMs, lateMs);
  const double errorMs = std::max({0.0, lateMs, stepMs_ * (truth.freeUntil - touch.toi)});
  ++found_;
  toiErrors_ += errorMs;
  score_.toiErrorMaxMs = std::max(score_.toiErrorMaxMs, errorMs);
}

TradeScore TradeScorer::score() const {
  TradeScore score = score_;
  if (found_ > 0) score.toiErrorMeanMs = toiErrors_ / static_cast<double>(found_);
  if (reported_ > 0) score.distanceErrorMean = distanceErrors_ / static_cast<double>(reported_);
  return score;
}

std::vector<std::string> strategiesOf(const TradeRows& rows) {
  std::vector<std::string> names;
  for (const TradeRow* const row : rows) {
    if (std::find(names.begin(), names.end(), row->strategy) == names.end()) {
      names.push_back(row->strategy);
    }
  }
  return names;
}

std::vector<bool> frontierOf(const std::vector<TradeChoice>& choices) {
  const auto beats = [](const TradeChoice& x, const TradeChoice& y) {
    return x.isSafe && x.cost <= y.cost && x.error <= y.error &&
           (x.cost < y.cost || x.error < y.error);
  };
  std::vector<bool> on;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    bool isBeaten = !choices[i].isSafe;
    for (std::size_t j = 0; j < choices.size(); ++j) {
      const bool isTwin = j < i && choices[j].isSafe && choices[j].cost == choices[i].cost &&
                          choices[j].error == choices[i].error;
      isBeaten = isBeaten || isTwin || beats(choices[j], choices[i]);
    }
    on.push_back(!isBeaten);
  }
  return on;
}

void markFrontier(std::vector<TradeRow>& rows) {
  std::vector<bool> isDone(rows.size(), false);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (isDone[i]) continue;
    std::vector<std::size_t> group;
    std::vector<TradeChoice> choices;
    for (std::size_t j = i; j < rows.size(); ++j) {
      const TradeRow& row = rows[j];
      if (row.scene != rows[i].scene || row.clip != rows[i].clip || row.rateHz != rows[i].rateHz) {
        continue;
      }
      isDone[j] = true;
      group.push_back(j);
      choices.push_back({row.us.mean, row.score.distanceErrorMean,
                         row.score.missed == 0 && row.score.late == 0 &&
                             std::isfinite(row.score.distanceErrorMean)});
    }
    const std::vector<bool> on = frontierOf(choices);
    for (std::size_t k = 0; k < group.size(); ++k) rows[group[k]].onFrontier = on[k];
  }
}

}  // namespace foretouch::tools
