#include "bench/trade/trade_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/trade/dominance.h"
#include "bench/trade/plot.h"
#include "tools/html_text.h"

namespace foretouch::tools {
namespace {

constexpr const char* kOurs = kForetouchStrategy;
constexpr char kPlain[] = "plain advancement";
constexpr char kPosesOnly[] = "poses only";

/// Draws points closer to touching than this (m) here.
constexpr double kLeastError = 1e-9;

/// Those of one scene and clip.
using Rows = TradeRows;

std::string lengthText(double m) {
  if (!std::isfinite(m)) return "unknown";
  if (m < 1e-3) return fmt::format("{:.3g} µm", 1e6 * m);
  return m < 1.0 ? fmt::format("{:.3g} mm", 1e3 * m) : fmt::format("{:.3g} m", m);
}

std::string colorOf(const TradeRow& row) {
  if (row.strategy == kOurs) return "#0b57a4";
  if (isForetouch(row)) return "#5b8fc7";
  return row.promise == TradePromise::Nothing ? "#c0392b" : "#9a6a00";
}

std::string noteOf(const TradeRow& row) {
  return fmt::format(
      "{}, eps {}, {:g} Hz: mean {:.2f} us, p99 {:.2f} us, {} of {} contacts missed, {} late, {} "
      "false, {} from touching",
      row.strategy, lengthText(row.tolerance), row.rateHz, row.us.mean, row.us.p99,
      row.score.missed, row.score.contacts, row.score.late, row.score.falseOnes,
      lengthText(row.score.distanceErrorMean));
}

template <typename IsWanted>
Rows only(const Rows& rows, const IsWanted& isWanted) {
  Rows some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some),
               [&](const TradeRow* row) { return isWanted(*row); });
  return some;
}

/// One line per strategy, with points by `place`.
template <typename Place>
std::vector<PlotLine> linesOf(const Rows& rows, const Place& place) {
  std::vector<PlotLine> lines;
  for (const std::string& name : strategiesOf(rows)) {
    PlotLine line;
    line.name = name;
    for (const TradeRow* const row : rows) {
      if (row->strategy != name) continue;
      line.color = colorOf(*row);
      line.isDashed = row->promise == TradePromise::Nothing;
      const auto [x, y] = place(*row);
      line.points.push_back({x, y, !isSafe(*row), noteOf(*row)});
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string whereText(const TradeRow& row) {
  return fmt::format("{} in {}", row.clip, row.scene);
}

/// The fastest row of a strategy; none if it has no row.
const TradeRow* find(const Rows& rows, const std::string& strategy, double tolerance) {
  for (const TradeRow* const row : rows) {
    if (row->strategy == strategy && row->tolerance == tolerance) return row;
  }
  return nullptr;
}

/// The quickest of those that missed nothing, were never late and never farther than `error` from
/// touching on average.
const TradeRow* quickest(const Rows& rows, double error) {
  const TradeRow* best = nullptr;
  for (const TradeRow* const row : rows) {
    if (!isSafe(*row) || !(row->score.distanceErrorMean <= error)) continue;
    if (best == nullptr || row->us.mean < best->us.mean) best = row;
  }
  return best;
}

/// The time of the best other strategy; empty if there is none.
std::string leadText(const Rows& rows, const TradeRow& winner, double error) {
  const TradeRow* const rival =
      quickest(only(rows, [](const TradeRow& row) { return !isForetouch(row); }), error);
  if (rival == nullptr || !isForetouch(winner)) return "";
  return fmt::format("; {} takes {:.0f} times that", rival->strategy,
                     rival->us.mean / winner.us.mean);
}

Plot latencyPlot(const Rows& all, const MeasuredTrade& bench) {
  const Rows rows = only(all, [&](const TradeRow& row) { return row.rateHz == bench.baseRateHz; });
  Plot plot;
  plot.x = {"mean time of a step, microseconds (logarithmic)", true, false};
  plot.y = {"mean distance from touching when reported (logarithmic)", true, false, lengthText};
  plot.lines = linesOf(rows, [](const TradeRow& row) {
    return std::pair(row.us.mean, std::isfinite(row.score.distanceErrorMean)
                                      ? std::max(kLeastError, row.score.distanceErrorMean)
                                      : row.score.distanceErrorMean);
  });
  PlotLine frontier;
  frontier.color = "#2e9e4f";
  frontier.isThick = true;
  Rows best = only(rows, [](const TradeRow& row) { return row.onFrontier; });
  std::sort(best.begin(), best.end(),
            [](const TradeRow* x, const TradeRow* y) { return x->us.mean < y->us.mean; });
  for (const TradeRow* const row : best) {
    frontier.points.push_back(
        {row->us.mean, std::max(kLeastError, row->score.distanceErrorMean), false, ""});
  }
  plot.lines.insert(plot.lines.begin(), std::move(frontier));
  const TradeRow* const winner = quickest(rows, bench.baseTolerance);
  plot.title = winner == nullptr
                   ? fmt::format("Nothing measured is within {} and misses nothing",
                                 lengthText(bench.baseTolerance))
                   : fmt::format(
                         "Within {} and with no contact missed, {} is the quickest: {:.1f} "
                         "microseconds a step{}",
                         lengthText(bench.baseTolerance), winner->strategy, winner->us.mean,
                         leadText(rows, *winner, bench.baseTolerance));
  plot.subtitle = fmt::format(
      "{}, {:g} Hz. Left is quicker, down is more accurate. A dot is a tolerance from {} to {}; a "
      "ring missed contacts or found them late. Nothing that misses nothing beats the green band.",
      whereText(*rows.front()), bench.baseRateHz,
      lengthText((*std::max_element(rows.begin(), rows.end(),
                                    [](auto* x, auto* y) { return x->tolerance < y->tolerance; }))
                     ->tolerance),
      lengthText((*std::min_element(rows.begin(), rows.end(), [](auto* x, auto* y) {
                   return x->tolerance < y->tolerance;
                 }))->tolerance));
  return plot;
}

Plot missesPlot(const Rows& all, const MeasuredTrade& bench) {
  const Rows rows =
      only(all, [&](const TradeRow& row) { return row.tolerance == bench.baseTolerance; });
  const auto place = [](const TradeRow& row) {
    return std::pair(row.rateHz, row.score.contacts > 0
                                     ? 100.0 * static_cast<double>(row.score.missed) /
                                           static_cast<double>(row.score.contacts)
                                     : 0.0);
  };
  Plot plot;
  plot.x = {"poses a second, Hz (logarithmic)", true, false};
  plot.y = {"contacts missed, %", false, false};
  plot.lines = linesOf(
      only(rows, [](const TradeRow& row) { return row.promise == TradePromise::Nothing; }), place);
  const Rows promising =
      only(rows, [](const TradeRow& row) { return row.promise != TradePromise::Nothing; });
  std::int64_t broken = 0;
  for (const TradeRow* const row : promising) broken += row->score.missed + row->score.late;
  PlotLine line;
  line.color = "#0b57a4";
  line.name = fmt::format("{} that promise not to miss", strategiesOf(promising).size());
  for (const TradeRow* const row : promising) {
    if (row->strategy != kOurs) continue;
    line.points.push_back({row->rateHz, 0.0, broken > 0, "none missed"});
  }
  plot.lines.push_back(std::move(line));
  for (PlotLine& each : plot.lines) each.isNamedAtStart = true;  // few poses: where they differ
  const Rows base = only(rows, [&](const TradeRow& row) { return row.rateHz == bench.baseRateHz; });
  const TradeRow* const poses = find(base, kPosesOnly, bench.baseTolerance);
  const std::string promise = broken == 0 ? "what promises to miss none misses none"
                                          : fmt::format("{} promises were broken", broken);
  plot.title = poses == nullptr
                   ? promise
                   : fmt::format(
                         "At {:g} Hz, looking at the poses alone misses {} of "
                         "{} contacts; {}",
                         bench.baseRateHz, poses->score.missed, poses->score.contacts, promise);
  plot.subtitle = fmt::format(
      "{}, tolerance {}. The same seconds of the clip at every rate. Sampling N looks at N more "
      "instants of each step; finding a contact late does not count as missing it here.",
      whereText(*rows.front()), lengthText(bench.baseTolerance));
  return plot;
}

Plot costPlot(const Rows& all, const MeasuredTrade& bench) {
  const Rows rows = only(all, [&](const TradeRow& row) { return row.rateHz == bench.baseRateHz; });
  Plot plot;
  plot.x = {"tolerance (logarithmic; finer to the right)", true, true, lengthText};
  plot.y = {"mean time of a step, microseconds (logarithmic)", true, false};
  plot.lines =
      linesOf(rows, [](const TradeRow& row) { return std::pair(row.tolerance, row.us.mean); });
  double finest = bench.baseTolerance;
  for (const TradeRow* const row : rows) finest = std::min(finest, row->tolerance);
  const auto grows = [&](const char* strategy) -> std::optional<double> {
    const TradeRow* const coarse = find(rows, strategy, bench.baseTolerance);
    const TradeRow* const fine = find(rows, strategy, finest);
    if (coarse == nullptr || fine == nullptr || !(coarse->us.mean > 0.0)) return std::nullopt;
    return fine->us.mean / coarse->us.mean;
  };
  const auto ours = grows(kOurs), plain = grows(kPlain);
  plot.title = ours && plain
                   ? fmt::format(
                         "From {} to {}, Foretouch's time grows {:.1f}-fold, plain "
                         "advancement's {:.1f}-fold",
                         lengthText(bench.baseTolerance), lengthText(finest), *ours, *plain)
                   : "What a finer tolerance costs";
  plot.subtitle = fmt::format(
      "{}, {:g} Hz. Flat lines pay nothing for accuracy; a ring missed contacts or found them "
      "late.",
      whereText(*rows.front()), bench.baseRateHz);
  return plot;
}

constexpr char kHead[] = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Foretouch: speed for accuracy</title>
<style>
body { font: 16px/1.45 system-ui, sans-serif; color: #1c2430; background: #fff; margin: 2rem auto; max-width: 1060px; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: 0.2rem; }
h2 { font-size: 1.25rem; margin: 0 0 0.2rem; }
figure { margin: 2rem 0; }
figure p { margin: 0 0 0.6rem; color: #4a5565; }
svg { width: 100%; height: auto; font: 13px system-ui, sans-serif; }
svg { color: #1c2430; }
svg .name { font-weight: 600; paint-order: stroke; stroke: #fff; stroke-width: 3px; }
svg .axis { font-size: 14px; }
.grid { stroke: #e3e7ec; }
.frame { fill: none; stroke: #8a94a3; }
.lead { font-size: 1.15rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; white-space: nowrap; }
caption { text-align: left; font-weight: 600; padding: 0.4rem 0; }
th { vertical-align: bottom; white-space: normal; }
th, td { border-bottom: 1px solid #e3e7ec; padding: 0.2rem 0.5rem; text-align: right; }
td.words, th.words { text-align: left; }
ul { color: #4a5565; }
</style>
</head>
<body>
)";

std::string cellText(const BenchCell& cell, int decimals) {
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  if (const auto* words = std::get_if<std::string>(&cell)) return *words;
  const double number = std::get<double>(cell);
  if (!std::isfinite(number)) return "-";
  return decimals < 0 ? fmt::format("{:.3g}", number) : fmt::format("{:.{}f}", number, decimals);
}

std::string tableHtml(const BenchTable& table) {
  std::string text =
      "<div class=\"scroll\"><table>\n<caption>" + inHtml(table.title) + "</caption>\n<tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool isWords =
        !table.rows.empty() && std::holds_alternative<std::string>(table.rows.front()[c]);
    text += std::string(isWords ? "<th class=\"words\">" : "<th>") +
            inHtml(table.columns[c].title) + "</th>";
  }
  text += "</tr>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const bool isWords = std::holds_alternative<std::string>(row[c]);
      text += std::string(isWords ? "<td class=\"words\">" : "<td>") +
              inHtml(cellText(row[c], table.columns[c].decimals)) + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string listHtml(const BenchReport& report) {
  std::string text = "<ul>\n";
  for (const auto& facts : {report.workload, report.machine}) {
    for (const auto& [name, value] : facts) {
      text += "<li>" + inHtml(name) + ": " + inHtml(value) + "</li>\n";
    }
  }
  for (const std::string& note : report.notes) text += "<li>" + inHtml(note) + "</li>\n";
  return text + "</ul>\n";
}

std::string worldHtml(const Rows& rows, const MeasuredTrade& bench) {
  const bool hasBase = std::any_of(rows.begin(), rows.end(), [&](const TradeRow* row) {
    return row->rateHz == bench.baseRateHz;
  });
  std::string text;
  if (hasBase) text += plotFigure(latencyPlot(rows, bench));
  text += plotFigure(missesPlot(rows, bench));
  if (hasBase) text += plotFigure(costPlot(rows, bench));
  return text;
}

}  // namespace

std::string tradePage(const MeasuredTrade& bench) {
  std::string page = kHead;
  page +=
      "<h1>Speed for accuracy</h1>\n<p>What a moving body touches between two poses, by every "
      "strategy measured: how long a step takes, what it misses, and how far off it is. "
      "Measured " +
      inHtml(bench.report.date) + " UTC.</p>\n<p class=\"lead\">" +
      inHtml(dominanceText(dominanceOf(bench.rows))) + "</p>\n";
  if (!bench.report.tables.empty()) page += tableHtml(bench.report.tables.front());
  std::vector<std::pair<std::string, Rows>> worlds;
  for (const TradeRow& row : bench.rows) {
    const std::string where = whereText(row);
    auto world = std::find_if(worlds.begin(), worlds.end(),
                              [&](const auto& known) { return known.first == where; });
    if (world == worlds.end()) world = worlds.insert(worlds.end(), {where, {}});
    world->second.push_back(&row);
  }
  for (const auto& [where, rows] : worlds) page += worldHtml(rows, bench);
  for (const BenchTable& table : bench.report.tables) page += tableHtml(table);
  page += "<h2>What it was measured on, and how</h2>\n" + listHtml(bench.report);
  return page + "</body>\n</html>\n";
}

}  // namespace foretouch::tools
