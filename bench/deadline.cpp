#include "bench/deadline.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/timing.h"
#include "tools/progress.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// One limit, and its results.
struct Limit {
  std::string name;
  double deadlineUs = std::numeric_limits<double>::infinity();
  QueryOptions query;
  std::int64_t asks = 0, whole = 0, links = 0, undecided = 0, unsound = 0;
  double freeOfUndecided = 0.0;
  std::vector<double> timesUs;
};

std::vector<Limit> limitsOf(const DeadlineRequest& request, QueryOptions query) {
  query.tolerance = request.tolerance;
  std::vector<Limit> limits;
  limits.push_back(
      {"none", std::numeric_limits<double>::infinity(), query, 0, 0, 0, 0, 0, 0.0, {}});
  for (const double deadlineUs : request.deadlinesUs) {
    Limit limit = limits.front();
    limit.name = fmt::format("{:g} us", deadlineUs);
    limit.query.deadlineUs = limit.deadlineUs = deadlineUs;
    limits.push_back(std::move(limit));
  }
  for (const int work : request.workBudgets) {
    Limit limit = limits.front();
    limit.name = fmt::format("work {}", work);
    limit.query.workBudget = static_cast<std::uint64_t>(work);
    limits.push_back(std::move(limit));
  }
  return limits;
}

Result<std::vector<StepContacts>> touchesOf(const Avatar& avatar,
                                            const std::vector<StepPoses>& steps, const Scene& scene,
                                            QueryOptions query, StepMemory& memory) {
  query.tolerance = kTouchTolerance;
  ReferenceOptions reference;
  reference.backtracking = Backtracking::Scalar;
  std::vector<StepContacts> touches;
  FORETOUCH_TRY(const auto asked, buildReference(avatar, scene, query, reference));
  for (const StepPoses& poses : steps) {
    answerStep(asked, poses, memory);
    touches.push_back(memory.contacts);
  }
  return touches;
}

void count(const StepContacts& answer, const StepContacts& touch, Limit& limit) {
  ++limit.asks;
  std::int64_t undecided = 0;
  for (const LinkContact& contact : answer.links) {
    if (contact.verdict != Verdict::Undecided) continue;
    ++undecided;
    limit.freeOfUndecided += contact.freeUntil;
  }
  limit.links += static_cast<std::int64_t>(answer.links.size());
  limit.undecided += undecided;
  limit.whole += undecided == 0 ? 1 : 0;
  limit.unsound += unsoundLinks(answer, touch);
}

BenchTable deadlineTable() {
  return {"deadlines",
          "What is answered in time, and by how much it is overrun",
          {{"limit", "limit", 0},
           {"asks", "queries", 0},
           {"whole_percent", "all links decided %", 2},
           {"undecided_percent", "links undecided %", 2},
           {"free_until", "of these free until, mean", 3},
           {"unsound", "unsound", 0},
           {"p50_us", "p50 us", 2},
           {"p99_us", "p99 us", 2},
           {"p999_us", "p99.9 us", 2},
           {"overrun_p50_us", "overrun p50 us", 2},
           {"overrun_p99_us", "p99 us", 2},
           {"overrun_p999_us", "p99.9 us", 2},
           {"overrun_max_us", "max us", 1}},
          {}};
}

std::vector<BenchCell> rowOf(Limit& limit) {
  std::sort(limit.timesUs.begin(), limit.timesUs.end());
  const auto percent = [](std::int64_t part, std::int64_t all) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::int64_t>(all, 1));
  };
  const auto overrun = [&](double timeUs) { return std::max(0.0, timeUs - limit.deadlineUs); };
  std::vector<BenchCell> row;
  row.reserve(13);
  row.emplace_back(limit.name);
  row.emplace_back(limit.asks);
  row.emplace_back(percent(limit.whole, limit.asks));
  row.emplace_back(percent(limit.undecided, limit.links));
  row.emplace_back(limit.undecided == 0
                       ? std::numeric_limits<double>::quiet_NaN()
                       : limit.freeOfUndecided / static_cast<double>(limit.undecided));
  row.emplace_back(limit.unsound);
  for (const double share : {0.5, 0.99, 0.999}) row.emplace_back(valueAtRank(limit.timesUs, share));
  for (const double share : {0.5, 0.99, 0.999}) {
    row.emplace_back(overrun(valueAtRank(limit.timesUs, share)));
  }
  row.emplace_back(overrun(limit.timesUs.back()));
  return row;
}

}  // namespace

std::int64_t unsoundLinks(const StepContacts& answer, const StepContacts& touch) {
  std::int64_t unsound = 0;
  for (std::size_t i = 0; i < answer.links.size(); ++i) {
    const LinkContact& said = answer.links[i];
    const LinkContact& touched = touch.links[i];
    const bool touches =
        touched.verdict == Verdict::Contact || touched.verdict == Verdict::StartsInContact;
    if (touches && said.freeUntil > touched.freeUntil + kTouchTime) ++unsound;
  }
  return unsound;
}

Result<JudgedReport> measureDeadlines(const DeadlineRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.options.files));
  FORETOUCH_TRY(const auto scene, refinedScene(inputs, request.triangles));
  FORETOUCH_TRY(const auto body, bodyOf(inputs, request.links));
  const auto query = queryFor(inputs, body, request.options);
  if (!query.ok()) return query.error();
  FORETOUCH_TRY(const auto workload, chooseSteps(inputs, body, request.options.workload));
  const auto steps = posesOf(inputs, body, workload);
  if (!steps.ok()) return steps.error();
  if (steps.value().empty()) {
    return Error::in("bench deadline", ErrorCode::Empty, "no steps were found");
  }
  const Avatar& avatar = body.avatar;
  StepMemory memory;
  FORETOUCH_TRY(const auto touches, touchesOf(avatar, steps.value(), scene, query.value(), memory));

  std::vector<Limit> limits = limitsOf(request, query.value());
  std::vector<Query> queries;
  for (const Limit& limit : limits) {
    FORETOUCH_TRY(auto limited,
                  buildReference(avatar, scene, limit.query, request.options.reference));
    queries.push_back(std::move(limited));
  }
  const auto numSteps = static_cast<std::int64_t>(steps.value().size());
  const std::int64_t passes = (request.asks + numSteps - 1) / numSteps;
  ProgressBar progress("deadlines", passes);
  for (std::int64_t pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < steps.value().size(); ++i) {
      for (std::size_t k = 0; k < limits.size(); ++k) {
        const Clock::time_point start = Clock::now();
        answerStep(queries[k], steps.value()[i], memory);
        const std::chrono::duration<double, std::micro> took = Clock::now() - start;
        limits[k].timesUs.push_back(took.count());
        count(memory.contacts, touches[i], limits[k]);
      }
    }
    progress.advanceTo(pass + 1);
  }

  JudgedReport bench{startedReport("deadline", "Deadlines and work budgets")};
  BenchReport& report = bench.report;
  report.workload = workloadFacts(inputs, scene, avatar, query.value(), request.options.reference);
  report.workload.emplace_back("steps", describe(workload));
  report.workload.emplace_back("tolerance", fmt::format("{:g} m", request.tolerance));
  BenchTable table = deadlineTable();
  for (Limit& limit : limits) {
    bench.violations += static_cast<std::uint64_t>(limit.unsound);
    table.rows.push_back(rowOf(limit));
  }
  report.tables.push_back(std::move(table));
  report.notes = {
      "Every query's answer is held against the same step's touch, which the scalar form finds at "
      "1e-7 m; unsound counts links that are said to be free beyond it. `./run oracle "
      "--deadline-us` and `--work-budget` judge the same by an oracle of its own.",
      "A deadline is looked at between pieces of work; the overrun is what the last piece, and the "
      "machine, took beyond it. Work is counted in evaluations in lanes and overruns nothing but "
      "the clock."};
  return bench;
}

namespace {

constexpr int kMaxWork = 1'000'000'000, kMaxAsks = 100'000'000;

ExitCode run(DeadlineRequest& request) {
  FORETOUCH_CHECK_OR(failed, complete(request.options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureDeadlines(request));
  return finished(bench, "links were said to be free beyond their touch", request.options.figures);
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
