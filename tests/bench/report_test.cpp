// tests/bench/report_test.cpp: reports as text, CSV, JSON and Markdown.
#include "bench/report.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/machine.h"

namespace foretouch::tools {
namespace {

BenchReport sample() {
  BenchReport report;
  report.kind = "latency";
  report.title = "Latency";
  report.command = "foretouch-bench latency";
  report.date = "2026-01-31 12:00";
  report.machine = {{"processor", "Some | Processor"}};
  report.workload = {{"scene", "room"}};
  report.tables = {
      {"steps",
       "Steps",
       {{"name", "name", 0}, {"count", "count", 0}, {"p50_us", "p50 us", 1}},
       {{std::string("a,\"b\""), std::int64_t{3}, 1.25},
        {std::string("c"), std::int64_t{4}, std::numeric_limits<double>::quiet_NaN()}}}};
  report.notes = {"A note."};
  return report;
}

TEST(BenchReport, SurvivesItsJson) {
  const auto again = parseReport(reportJson(sample()), "x.json");
  ASSERT_TRUE(again.ok()) << describe(again.error());
  EXPECT_EQ(reportJson(again.value()), reportJson(sample()));
  EXPECT_EQ(std::get<std::int64_t>(again.value().tables[0].rows[0][1]), 3);
  EXPECT_EQ(std::get<double>(again.value().tables[0].rows[0][2]), 1.25);
  EXPECT_TRUE(std::isnan(std::get<double>(again.value().tables[0].rows[1][2])));
}

TEST(BenchReport, RefusesOtherJson) {
  for (const char* text : {"", "[]", "{}", R"({"format":"foretouch-bench","version":2})",
                           R"({"format":"foretouch-bench","version":1,"kind":3})"}) {
    const auto parsed = parseReport(text, "x.json");
    ASSERT_FALSE(parsed.ok()) << text;
    EXPECT_EQ(parsed.error().file, "x.json");
  }
}

TEST(TableCsv, QuotesWordsAndLeavesGaps) {
  EXPECT_EQ(tableCsv(sample().tables[0]), "name,count,p50_us\n\"a,\"\"b\"\"\",3,1.25\nc,4,\n");
}

TEST(CommandLine, QuotesWordsAndNamesFilesWithoutTheirFolders) {
  EXPECT_EQ(commandLine({"--scene", "/some/where/a room.obj", "--place", "0,0,0", "it's"}),
            "foretouch-bench --scene 'a room.obj' --place 0,0,0 'it'\\''s'");
}

TEST(TableText, ShortensNumbersWithoutFixedDecimals) {
  const BenchTable table{"t", "T", {{"x", "x", -1}}, {{1e-5}, {300000.0}}};
  EXPECT_EQ(tableText(table), "T\n       x\n   1e-05\n  300000\n");
}

TEST(TableText, AlignsColumns) {
  EXPECT_EQ(tableText(sample().tables[0]),
            "Steps\n  name   count  p50 us\n  a,\"b\"      3     1.2\n  c          4       -\n");
}

TEST(ReportMarkdown, KeepsBarsInTheirCells) {
  const std::string text = reportMarkdown(sample());
  EXPECT_NE(text.find("Some \\| Processor"), std::string::npos);
  EXPECT_NE(text.find("| c | 4 | - |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("`foretouch-bench latency`, 2026-01-31 12:00 UTC."), std::string::npos);
}

}  // namespace
}  // namespace foretouch::tools
