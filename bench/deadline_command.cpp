#include <memory>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/deadline.h"
#include "tools/settings/lists.h"
#include "bench/options.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

constexpr int kMaxWork = 1'000'000'000, kMaxAsks = 100'000'000;

ExitCode run(DeadlineRequest& request) {
  BenchOptions& options = request.options;
  FORETOUCH_CHECK_OR(failed, complete(options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureDeadlines(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed,
                     writeReport(report, options.jsonPath, report.tables.front(), options.csvPath));
  printOut(reportText(report));
  if (bench.unsound == 0) return ExitCode::Done;
  printError(fmt::format("{} links were said to be free beyond their touch", bench.unsound));
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command deadlineCommand() {
  const auto request = std::make_shared<DeadlineRequest>();
  request->deadlinesUs = {5, 10, 20, 50};
  request->workBudgets = {500, 1000, 2000, 5000};
  Settings settings;
  addNumbers(settings, "--deadlines", "US,...", request->deadlinesUs, kAboveZero,
             "By the clock, microseconds");
  addCounts(settings, "--work", "N,...", request->workBudgets, kMaxWork,
            "By work: evaluations in lanes");
  settings.whole("--asks", "N", request->asks, 1, kMaxAsks, "Queries of each");
  settings.number("--rate", "HZ", request->options.workload.rateHz, kAboveZero, "Poses per second");
  settings.number("--tolerance", "M", request->tolerance, kToleranceRange, "Tolerance (m)");
  addLinks(settings, "--links", request->links);
  addTriangles(settings, "--triangles", request->triangles);
  addBenchOptions(settings, request->options);
  Command command{"deadline",
                  "Queries that may cost only so much; exit code 1 where one claims too much",
                  "Example, feet that graze the floor:\n"
                  "  foretouch-bench deadline --lift 0.0012 --choice mix --asks 250000",
                  std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
