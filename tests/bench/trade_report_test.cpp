// tests/bench/trade_report_test.cpp: the frontier, the scores and the recommendation.
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/trade/dominance.h"
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
