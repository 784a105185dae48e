#include "bench/trade/trade_tables.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "bench/trade/dominance.h"

namespace foretouch::tools {
namespace {

using Rows = TradeRows;

const char* wordFor(TradePromise promise) {
  switch (promise) {
    case TradePromise::Sound: return "never misses";
    case TradePromise::Accurate: return "never misses, within eps";
    default: return "may miss";
  }
}

template <typename IsWanted>
Rows only(const std::vector<TradeRow>& rows, const IsWanted& isWanted) {
  Rows some;
  for (const TradeRow& row : rows) {
    if (isWanted(row)) some.push_back(&row);
  }
  return some;
}

const TradeRow* strategyIn(const Rows& rows, const TradeRow& run, const std::string& strategy) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const TradeRow* row) {
    return isSameRun(*row, run) && row->strategy == strategy;
  });
  return found == rows.end() ? nullptr : *found;
}

/// The quickest strategy of others in that run that was safe and keeps the tolerance.
const TradeRow* bestRival(const Rows& rows, const TradeRow& run) {
  const TradeRow* best = nullptr;
  for (const TradeRow* const row : rows) {
    const bool isRival = isSameRun(*row, run) && !isForetouch(*row) && isSafe(*row) &&
                         row->promise == TradePromise::Accurate;
    if (isRival && (best == nullptr || row->us.mean < best->us.mean)) best = row;
  }
  return best;
}

BenchTable leadTable(const Rows& base, double tolerance, double rateHz) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  BenchTable table{
      "lead",
      fmt::format("By how much, at {:g} m and {:g} Hz: of strategies that miss nothing", tolerance,
                  rateHz),
      {{"scene", "scene", 0},
       {"clip", "clip", 0},
       {"foretouch_us", "Foretouch us", 1},
       {"scalar_us", "its scalar form us", 1},
       {"rival", "best other strategy", 0},
       {"rival_us", "us", 1},
       {"factor", "times quicker", 1},
       {"poses_missed", "poses only: missed", 0},
       {"contacts", "of contacts", 0}},
      {}};
  for (const TradeRow* const own : base) {
    if (own->strategy != kForetouchStrategy) continue;
    const TradeRow* const scalar = strategyIn(base, *own, "Foretouch, scalar");
    const TradeRow* const poses = strategyIn(base, *own, "poses only");
    const TradeRow* const rival = bestRival(base, *own);
    table.rows.push_back(
        {own->scene, own->clip, own->us.mean, scalar != nullptr ? scalar->us.mean : kUnknown,
         std::string(rival != nullptr ? rival->strategy : "none"),
         rival != nullptr ? rival->us.mean : kUnknown,
         rival != nullptr ? rival->us.mean / own->us.mean : kUnknown,
         poses != nullptr ? poses->score.missed : std::int64_t{0}, own->score.contacts});
  }
  return table;
}

/// Several runs of one strategy: counts added, means weighted by steps, the worst of the rest.
struct Together {
  TradeScore score;
  double us = 0.0, p99Us = 0.0, toiErrorMs = 0.0, distanceError = 0.0;

  void add(const TradeRow& row) {
    const TradeScore& s = row.score;
    const auto steps = static_cast<double>(s.steps);
    us += steps * row.us.mean;
    toiErrorMs += steps * s.toiErrorMeanMs;
    distanceError += steps * s.distanceErrorMean;
    p99Us = std::max(p99Us, row.us.p99);
    score.steps += s.steps;
    score.contacts += s.contacts;
    score.missed += s.missed;
    score.late += s.late;
    score.falseOnes += s.falseOnes;
    score.lateMaxMs = std::max(score.lateMaxMs, s.lateMaxMs);
    score.distanceErrorMax = std::max(score.distanceErrorMax, s.distanceErrorMax);
  }
};

BenchTable strategyTable(const Rows& base, double tolerance, double rateHz) {
  BenchTable table{
      "strategies",
      fmt::format("Every strategy at {:g} m and {:g} Hz, all scenes and clips together", tolerance,
                  rateHz),
      {{"strategy", "strategy", 0},
       {"promise", "promise", 0},
       {"steps", "steps", 0},
       {"contacts", "contacts", 0},
       {"missed", "missed", 0},
       {"late", "late", 0},
       {"late_max_ms", "late max ms", 1},
       {"false", "false", 0},
       {"toi_error_mean_ms", "toi error ms", 3},
       {"distance_error_mean_m", "distance error m", -1},
       {"distance_error_max_m", "max m", -1},
       {"mean_us", "mean us", 1},
       {"p99_us", "worst p99 us", 1}},
      {}};
  for (const std::string& name : strategiesOf(base)) {
    Together all;
    const char* promise = "";
    for (const TradeRow* const row : base) {
      if (row->strategy != name) continue;
      all.add(*row);
      promise = wordFor(row->promise);
    }
    const auto steps = static_cast<double>(std::max<std::int64_t>(1, all.score.steps));
    table.rows.push_back({name, std::string(promise), all.score.steps, all.score.contacts,
                          all.score.missed, all.score.late, all.score.lateMaxMs,
                          all.score.falseOnes, all.toiErrorMs / steps, all.distanceError / steps,
                          all.score.distanceErrorMax, all.us / steps, all.p99Us});
  }
  return table;
}

BenchTable missTable(const std::vector<TradeRow>& rows, double tolerance) {
  const Rows wanted = only(rows, [&](const TradeRow& row) { return row.tolerance == tolerance; });
  std::set<double> rates;
  for (const TradeRow* const row : wanted) rates.insert(row->rateHz);
  BenchTable table{"misses",
                   fmt::format("Contacts missed at {:g} m, all scenes and clips together (not "
                               "every clip has every rate); whoever is not here missed nothing",
                               tolerance),
                   {{"strategy", "strategy", 0}},
                   {}};
  for (const double rate : rates) {
    table.columns.push_back({fmt::format("at_{:g}_hz", rate), fmt::format("{:g} Hz", rate), 0});
  }
  for (const std::string& name : strategiesOf(wanted)) {
    std::map<double, std::pair<std::int64_t, std::int64_t>> missedOf;  // per rate: missed, contacts
    std::int64_t missed = 0;
    for (const TradeRow* const row : wanted) {
      if (row->strategy != name) continue;
      missedOf[row->rateHz].first += row->score.missed;
      missedOf[row->rateHz].second += row->score.contacts;
      missed += row->score.missed;
    }
    if (missed == 0) continue;
    std::vector<BenchCell> cells = {name};
    for (const double rate : rates) {
      const auto [lost, contacts] = missedOf[rate];
      cells.emplace_back(fmt::format("{} of {}", lost, contacts));
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

BenchTable frontierTable(const std::vector<TradeRow>& rows, double rateHz) {
  BenchTable table{"frontier",
                   fmt::format("What nothing beats in both speed and distance from touching, at "
                               "{:g} Hz, with nothing missed or late",
                               rateHz),
                   {{"scene", "scene", 0},
                    {"clip", "clip", 0},
                    {"strategy", "strategy", 0},
                    {"tolerance_m", "eps m", -1},
                    {"mean_us", "mean us", 1},
                    {"distance_error_mean_m", "distance error m", -1},
                    {"distance_error_max_m", "max m", -1},
                    {"toi_error_mean_ms", "toi error ms", 4}},
                   {}};
  for (const TradeRow& row : rows) {
    if (!row.onFrontier || row.rateHz != rateHz) continue;
    table.rows.push_back({row.scene, row.clip, row.strategy, row.tolerance, row.us.mean,
                          row.score.distanceErrorMean, row.score.distanceErrorMax,
                          row.score.toiErrorMeanMs});
  }
  return table;
}

}  // namespace

BenchTable tradeTable(const std::vector<TradeRow>& rows, const std::string& name,
                      const std::string& title) {
  BenchTable table{name,
                   title,
                   {{"scene", "scene", 0},
                    {"clip", "clip", 0},
                    {"strategy", "strategy", 0},
                    {"promise", "promise", 0},
                    {"tolerance_m", "eps m", -1},
                    {"rate_hz", "Hz", -1},
                    {"steps", "steps", 0},
                    {"contacts", "contacts", 0},
                    {"starts", "starts", 0},
                    {"missed", "missed", 0},
                    {"false", "false", 0},
                    {"late", "late", 0},
                    {"late_max_ms", "late max ms", 2},
                    {"toi_error_mean_ms", "toi err ms", 4},
                    {"toi_error_max_ms", "max", 3},
                    {"distance_error_mean_m", "dist err m", -1},
                    {"distance_error_max_m", "max m", -1},
                    {"mean_us", "mean us", 2},
                    {"p50_us", "p50", 2},
                    {"p90_us", "p90", 2},
                    {"p99_us", "p99", 2},
                    {"nodes", "nodes/step", 1},
                    {"pairs", "pairs/step", 1},
                    {"states", "states/step", 1},
                    {"frontier", "frontier", 0}},
                   {}};
  for (const TradeRow& row : rows) {
    const auto steps = static_cast<double>(row.score.steps);
    const TradeScore& s = row.score;
    table.rows.push_back({row.scene,
                          row.clip,
                          row.strategy,
                          std::string(wordFor(row.promise)),
                          row.tolerance,
                          row.rateHz,
                          s.steps,
                          s.contacts,
                          s.starts,
                          s.missed,
                          s.falseOnes,
                          s.late,
                          s.lateMaxMs,
                          s.toiErrorMeanMs,
                          s.toiErrorMaxMs,
                          s.distanceErrorMean,
                          s.distanceErrorMax,
                          row.us.mean,
                          row.us.p50,
                          row.us.p90,
                          row.us.p99,
                          static_cast<double>(row.work.nodes) / steps,
                          static_cast<double>(row.work.pairs) / steps,
                          static_cast<double>(row.work.states) / steps,
                          std::string(row.onFrontier ? "yes" : "")});
  }
  return table;
}

std::vector<BenchTable> tablesForPeople(const std::vector<TradeRow>& rows, double tolerance,
                                        double rateHz) {
  const Rows base = only(rows, [&](const TradeRow& row) {
    return row.tolerance == tolerance && row.rateHz == rateHz;
  });
  return {leadTable(base, tolerance, rateHz), strategyTable(base, tolerance, rateHz),
          missTable(rows, tolerance), frontierTable(rows, rateHz)};
}

}  // namespace foretouch::tools
