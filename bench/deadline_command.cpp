#include "bench/deadline_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/deadline.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

constexpr int kMaxWork = 1'000'000'000, kMaxAsks = 100'000'000;

struct DeadlineTexts : BenchTexts {
  std::string rate = "5", tolerance = "0.001", links = "own", triangles = "own";
  std::string deadlines = "5,10,20,50", work = "500,1000,2000,5000", asks = "100000";
};

Result<DeadlineRequest> settledDeadline(const DeadlineTexts& texts) {
  DeadlineRequest request;
  Settling settle;
  settle.into(request.options, settled(texts));
  settle.into(request.options.workload.rateHz, parsePositive("--rate", texts.rate));
  settle.into(request.tolerance, parseTolerance("--tolerance", texts.tolerance));
  settle.into(request.links, parseOwnOrCount("--links", texts.links, kMaxBenchLinks));
  int triangles = 0, asks = 0;
  settle.into(triangles, parseOwnOrCount("--triangles", texts.triangles, kMaxBenchTriangles));
  settle.into(request.deadlinesUs, parsePositives("--deadlines", texts.deadlines));
  settle.into(request.workBudgets, parseCounts("--work", texts.work, kMaxWork));
  settle.into(asks, parseCount("--asks", texts.asks, kMaxAsks));
  if (settle.error()) return *settle.error();
  request.triangles = countOf(triangles);
  request.asks = asks;
  return request;
}

ExitCode run(const DeadlineTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledDeadline(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureDeadlines(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  if (bench.unsound == 0) return ExitCode::Done;
  printError(fmt::format("{} links were said to be free beyond their touch", bench.unsound));
  return ExitCode::CheckSaysNo;
}

}  // namespace

void addBenchDeadlineCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<DeadlineTexts>();
  CLI::App* const command = bench.add_subcommand(
      "deadline", "Queries that may cost only so much; exit code 1 where one claims too much");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--deadlines", texts->deadlines, "US,...", "By the clock, microseconds");
  option("--work", texts->work, "N,...", "By work: evaluations in lanes");
  option("--asks", texts->asks, "N", "Queries of each");
  option("--rate", texts->rate, "HZ", "Poses per second");
  option("--tolerance", texts->tolerance, "M", "Tolerance (m)");
  option("--links", texts->links, "N|own", "Links: fewer are cut off, more are grown");
  option("--triangles", texts->triangles, "N|own", "Triangles that the scene is divided into");
  addBenchOptions(*command, *texts);
  command->footer(
      "Example, feet that graze the floor:\n"
      "  foretouch-bench deadline --lift 0.0012 --choice mix --asks 250000");
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
