// tests/bench/trade_report_test.cpp: the frontier, the scores, the page and the
// recommendation.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/trade.h"
#include "bench/trade/dominance.h"
#include "bench/trade/plot.h"
#include "bench/trade/trade_page.h"
#include "bench/trade/trade_tables.h"
#include "bench/tune.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

TEST(TradeFrontier, KeepsWhatNothingBeats) {
  const std::vector<TradeChoice> choices = {
      {1.0, 5.0, true},  {2.0, 2.0, true}, {3.0, 2.0, true},  // beaten: as wrong, and slower
      {2.5, 1.0, false},                                      // unsafe
      {4.0, 0.5, true},  {4.0, 0.5, true},                    // equal: the first
      {5.0, 0.6, true}};
  EXPECT_EQ(frontierOf(choices), (std::vector<bool>{true, true, false, false, true, false, false}));
  EXPECT_TRUE(frontierOf({}).empty());
}

TradeRow row(const std::string& strategy, double meanUs, double error, std::int64_t missed) {
  TradeRow result;
  result.scene = "room <1> & \"two\".obj";
  result.clip = "clip.bvh";
  result.strategy = strategy;
  result.promise = missed > 0 ? TradePromise::Nothing : TradePromise::Accurate;
  result.tolerance = 1e-3;
  result.rateHz = 5.0;
  result.score.steps = 10;
  result.score.contacts = 4;
  result.score.missed = missed;
  result.score.distanceErrorMean = error;
  result.us = {meanUs, meanUs, meanUs, meanUs, meanUs};
  return result;
}

TEST(TradeFrontier, LeavesOutMissesAndWhatIsNotKnown) {
  std::vector<TradeRow> rows = {row("poses only", 1.0, 1e-6, 2), row("Foretouch", 2.0, 1e-4, 0),
                                row("exact", 1.5, std::numeric_limits<double>::quiet_NaN(), 0)};
  rows.push_back(row("Foretouch", 9.0, 1e-3, 0));
  rows.back().rateHz = 30.0;  // a group of its own
  markFrontier(rows);
  EXPECT_FALSE(rows[0].onFrontier);
  EXPECT_TRUE(rows[1].onFrontier);
  EXPECT_FALSE(rows[2].onFrontier);
  EXPECT_TRUE(rows[3].onFrontier);
}

TEST(TradeDominance, CountsWhatIsBeatenAndWhatIsNot) {
  std::vector<TradeRow> rows = {
      row("Foretouch", 2.0, 5e-4, 0),
      row("plain advancement", 50.0, 9e-4, 0),
      row("voxel sweep", 30.0, 4e-4, 0),  // slower, but closer: not beaten
      row("carried certificates", 60.0, 9e-4, 0),
      row("poses only", 1.0, 1e-2, 2),
      row("Foretouch, avatar", 90.0, 1.0, 0)};
  rows[2].promise = TradePromise::Sound;
  rows.push_back(row("plain advancement", 10.0, 9e-4, 0));
  rows.back().rateHz = 30.0;  // nothing of ours there
  const TradeDominance dominance = dominanceOf(rows);
  EXPECT_EQ(dominance.rivals, 4);
  EXPECT_EQ(dominance.beaten, 2);
  EXPECT_EQ(dominance.factors, (std::vector<double>{25.0, 30.0}));
  EXPECT_NE(dominanceText(dominance).find("4 settings; 2 of these are beaten"), std::string::npos);
  rows[0].score.late = 1;  // what is late beats nobody
  EXPECT_EQ(dominanceOf(rows).beaten, 0);
}

TEST(TradeTables, TellTheLeadAndAddUp) {
  std::vector<TradeRow> rows = {row("Foretouch", 2.0, 5e-4, 0),
                                row("plain advancement", 50.0, 9e-4, 0),
                                row("poses only", 1.0, 1e-2, 2)};
  rows.push_back(rows[2]);
  rows.back().clip = "other.bvh";
  const auto tables = tablesForPeople(rows, 1e-3, 5.0);
  ASSERT_EQ(tables.size(), 4u);
  ASSERT_EQ(tables[0].rows.size(), 1u);
  EXPECT_EQ(std::get<std::string>(tables[0].rows[0][4]), "plain advancement");
  EXPECT_EQ(std::get<double>(tables[0].rows[0][6]), 25.0);
  EXPECT_EQ(std::get<std::int64_t>(tables[0].rows[0][7]), 2);
  ASSERT_EQ(tables[1].rows.size(), 3u);
  EXPECT_EQ(std::get<std::int64_t>(tables[1].rows[2][4]), 4);  // missed, both clips
  ASSERT_EQ(tables[2].rows.size(), 1u);
  EXPECT_EQ(std::get<std::string>(tables[2].rows[0][1]), "4 of 8");
}

/// Every tag is closed, in order; what closes itself or needs no end is passed over.
void expectWellFormed(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const bool closes = html[at + 1] == '/';
    const std::size_t first = at + (closes ? 2 : 1);
    const std::string name = html.substr(first, html.find_first_of(" >\n/", first) - first);
    if (name == "!DOCTYPE" || name == "meta" || html[end - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << name;
    EXPECT_EQ(open.back(), name) << html.substr(at, 80);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

TEST(TradePage, IsWellFormedAndNeedsNoNetwork) {
  MeasuredTrade bench;
  bench.baseTolerance = 1e-3;
  bench.baseRateHz = 5.0;
  bench.rows = {row("poses only", 1.0, 1e-2, 2), row("plain advancement", 50.0, 9e-4, 0),
                row("Foretouch", 2.0, 5e-4, 0)};
  bench.rows.push_back(row("Foretouch", 3.0, 0.0, 0));
  bench.rows.back().tolerance = 1e-6;
  bench.rows.push_back(row("Foretouch, exact", 5.0, std::nan(""), 0));
  markFrontier(bench.rows);
  bench.report.tables = {tradeTable(bench.rows, "rows", "<all> & \"more\"")};
  bench.report.notes = {"a < b"};
  const std::string page = tradePage(bench);
  expectWellFormed(page);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<1>"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_NE(page.find("misses 2 of 4 contacts; what promises to miss none misses none"),
            std::string::npos);
  EXPECT_NE(page.find("Foretouch is the quickest: 2.0 microseconds"), std::string::npos);
}

TEST(TradePage, SaysWhereAPromiseWasBroken) {
  MeasuredTrade bench;
  bench.baseTolerance = 1e-3;
  bench.baseRateHz = 5.0;
  bench.rows = {row("poses only", 1.0, 1e-2, 2), row("Foretouch", 2.0, 5e-4, 3)};
  bench.rows[1].promise = TradePromise::Accurate;
  markFrontier(bench.rows);
  const std::string page = tradePage(bench);
  expectWellFormed(page);
  EXPECT_NE(page.find("3 promises were broken"), std::string::npos);
  EXPECT_NE(page.find("Nothing measured is within 1 mm and misses nothing"), std::string::npos);
}

TEST(Plots, EmptyAndSingleValuesAreDrawn) {
  Plot plot;
  plot.title = "nothing";
  expectWellFormed(plotFigure(plot));
  plot.lines.push_back(
      {"one", "#000", false, false, {{5.0, 0.0, false, ""}, {3.0, 3.0, true, ""}}, false});
  expectWellFormed(plotFigure(plot));
  plot.y.isLog = false;
  const std::string figure = plotFigure(plot);
  expectWellFormed(figure);
  EXPECT_EQ(figure.find("inf"), std::string::npos);
}

TunedSetting setting(Fidelity fidelity, double tolerance, double p99, std::int64_t falseOnes) {
  TunedSetting result;
  result.fidelity = fidelity;
  result.tolerance = tolerance;
  result.row.us.p99 = p99;
  result.row.score.falseOnes = falseOnes;
  return result;
}

TEST(Tune, RecommendsTheFinestWithinTheBudget) {
  const std::vector<TunedSetting> settings = {
      setting(Fidelity::Link, 1e-1, 5.0, 9), setting(Fidelity::Link, 1e-2, 10.0, 0),
      setting(Fidelity::Link, 1e-4, 15.0, 0), setting(Fidelity::Exact, 1e-3, 40.0, 0)};
  EXPECT_EQ(recommended(settings, 100.0)->setting, 3u);
  EXPECT_EQ(recommended(settings, 20.0)->setting, 2u);
  EXPECT_EQ(recommended(settings, 12.0)->setting, 1u);
  EXPECT_EQ(recommended(settings, 6.0)->setting, 0u);
  EXPECT_TRUE(recommended(settings, 6.0)->isWithinBudget);
  EXPECT_EQ(recommended(settings, 1.0)->setting, 0u);
  EXPECT_FALSE(recommended(settings, 1.0)->isWithinBudget);
  EXPECT_FALSE(recommended({}, 1.0).has_value());
}

TEST(Tune, NeverRecommendsWhatMissedOrWasLate) {
  std::vector<TunedSetting> settings = {setting(Fidelity::Exact, 1e-6, 1.0, 0),
                                        setting(Fidelity::Link, 1e-6, 1.0, 0)};
  settings[0].row.score.missed = 1;
  settings[1].row.score.late = 1;
  EXPECT_FALSE(recommended(settings, 100.0).has_value());
  settings.push_back(setting(Fidelity::Link, 1e-2, 99.0, 50));
  EXPECT_EQ(recommended(settings, 100.0)->setting, 2u);
}

}  // namespace
}  // namespace foretouch::tools
