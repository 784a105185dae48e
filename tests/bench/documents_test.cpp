// tests/bench/documents_test.cpp: what is made of benchmark files.
#include "bench/documents.h"

#include <cmath>

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

BenchReport latency(double nodes) {
  BenchReport report;
  report.kind = "latency";
  report.title = "Latency";
  report.machine = {{"processor", "Some"}, {"compiler", "gcc"}};
  report.tables = {
      {"latency", "Latency", {{"steps", "steps", 0}}, {{std::int64_t{4}}}},
      {"counters", "Counters", {{"rate_hz", "Hz", 0}, {"nodes", "nodes", 0}}, {{10.0, nodes}}}};
  return report;
}

TEST(CallgrindInstructions, ReadsTheTotals) {
  const auto read = callgrindInstructions("events: Ir\n1 2\ntotals: 8200\n", "x");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value(), 8200);
  EXPECT_EQ(callgrindInstructions("events: Ir\nsummary: 77\n\nfn=1\n", "x").value(), 77);
  for (const char* text : {"", "totals", "\ntotals: \n", "\ntotals: 0\n", "\ntotals: x\n"}) {
    EXPECT_FALSE(callgrindInstructions(text, "x").ok()) << text;
  }
}

TEST(InstructionReport, GivesInstructionsAndCountersAStep) {
  const auto report = instructionReport(latency(7.0), 8200);
  ASSERT_TRUE(report.ok());
  const BenchTable& table = report.value().tables.front();
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(std::get<double>(table.rows[0][1]), 2050.0);
  EXPECT_EQ(std::get<std::string>(table.rows[1][0]), "nodes");
  EXPECT_EQ(std::get<double>(table.rows[1][1]), 7.0);
  EXPECT_EQ(report.value().machine.size(), 1u);
  EXPECT_FALSE(instructionReport(BenchReport{}, 1).ok());
}

TEST(MovedTable, SaysByHowMuch) {
  const BenchReport before = instructionReport(latency(8.0), 4000).value();
  BenchReport now = instructionReport(latency(6.0), 4400).value();
  now.tables.front().rows.push_back({std::string("new"), 1.0});
  const BenchTable moved = movedTable(before, now);
  ASSERT_EQ(moved.rows.size(), 3u);
  EXPECT_NEAR(std::get<double>(moved.rows[0][3]), 10.0, 1e-9);
  EXPECT_NEAR(std::get<double>(moved.rows[1][3]), -25.0, 1e-9);
  EXPECT_TRUE(std::isnan(std::get<double>(moved.rows[2][3])));
  EXPECT_EQ(std::get<double>(movedTable(before, before).rows[1][3]), 0.0);
}

}  // namespace
}  // namespace foretouch::tools
