#include "bench/latency.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "middleware/contact.h"
#include "tools/report/document_parts.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// The measurements at one rate.
struct RateTimes {
  double rateHz;
  const Workload& workload;
  const std::vector<BenchCase>& cases;
  const Timing& timing;

  [[nodiscard]] double raySetUs() const { return percentilesOf(timing.raySetUs).p50; }
};

template <typename Field>
std::vector<double> column(const CaseTimes& times, Field field) {
  std::vector<double> values;
  for (const TimedStep& step : times.steps) values.push_back(static_cast<double>(field(step)));
  return values;
}

double warmOf(const TimedStep& step) {
  return step.warmUs;
}

/// Vector instructions, and what else the case asks.
std::string vectorsOf(const BenchCase& way) {
  return std::string(toString(way.simd)) + (way.query.self ? ", own links too" : "");
}

BenchTable latencyTable() {
  return {"latency",
          "Latency of a step, microseconds, and in ray-sets",
          {{"rate_hz", "Hz", -1},
           {"tolerance_m", "tolerance m", -1},
           {"simd", "vectors", 0},
           {"caches", "caches", 0},
           {"steps", "steps", 0},
           {"mean_us", "mean", 2},
           {"p50_us", "p50", 2},
           {"p90_us", "p90", 2},
           {"p99_us", "p99", 2},
           {"max_us", "max", 1},
           {"ray_set_us", "ray-set", 3},
           {"mean_ray_sets", "mean/rays", 1},
           {"p50_ray_sets", "p50/rays", 1},
           {"p99_ray_sets", "p99/rays", 1}},
          {}};
}

BenchTable countersTable() {
  BenchTable table{
      "counters",
      "Work of a step, mean counts",
      {{"rate_hz", "Hz", -1}, {"tolerance_m", "tolerance m", -1}, {"simd", "vectors", 0}},
      {}};
  for (const char* key : {"contacts", "starts", "undecided"}) {
    table.columns.push_back({key, key, 3});
  }
  for (const auto& [name, field] : kCounterFields) table.columns.push_back({name, name, 2});
  return table;
}

BenchTable ratiosTable() {
  return {"ratios", "Ratios within this run", {{"what", "what", 0}, {"ratio", "ratio", 2}}, {}};
}

BenchTable rawTable() {
  BenchTable table{"steps", "Steps", {}, {}};
  for (const char* key :
       {"rate_hz", "tolerance_m", "simd", "step", "x", "y", "z", "yaw_deg", "frame", "once_us",
        "warm_us", "first_us", "cold_us", "ray_set_us", "contacts", "starts", "undecided"}) {
    table.columns.push_back({key, key, 3});
  }
  for (const auto& [name, field] : kCounterFields) table.columns.push_back({name, name, 0});
  return table;
}

/// What a case adds, per step.
std::vector<double> whatIsAdded(const CaseTimes& times, const CaseTimes& base) {
  std::vector<double> added;
  for (std::size_t i = 0; i < times.steps.size(); ++i) {
    added.push_back(times.steps[i].warmUs - base.steps[i].warmUs);
  }
  return added;
}

void addLatencyRows(const RateTimes& at, BenchTable& table) {
  const double rays = at.raySetUs();
  for (std::size_t c = 0; c < at.cases.size(); ++c) {
    const BenchCase& way = at.cases[c];
    const CaseTimes& times = at.timing.cases[c];
    const auto add = [&](const char* caches, std::vector<double> values) {
      const auto count = static_cast<std::int64_t>(values.size());
      const Percentiles p = percentilesOf(std::move(values));
      table.rows.push_back({at.rateHz, way.query.tolerance, vectorsOf(way), std::string(caches),
                            count, p.mean, p.p50, p.p90, p.p99, p.max, rays, p.mean / rays,
                            p.p50 / rays, p.p99 / rays});
    };
    if (way.cold) add("asked once", column(times, [](const TimedStep& s) { return s.onceUs; }));
    add("warm", column(times, warmOf));
    if (way.query.self) add("warm, what own links add", whatIsAdded(times, at.timing.cases[0]));
    if (c > 0) continue;
    add("first of all", column(times, [](const TimedStep& s) { return s.firstUs; }));
    add("every repeat", times.everyUs);
    if (way.cold) add("cold", column(times, [](const TimedStep& s) { return s.coldUs; }));
  }
}

/// The mean counts of a step, in the order of the table's columns from "contacts" on.
std::vector<BenchCell> meanCounts(const CaseTimes& times) {
  const auto mean = [&](auto field) { return percentilesOf(column(times, field)).mean; };
  std::vector<BenchCell> counts = {mean([](const TimedStep& s) { return s.contacts; }),
                                   mean([](const TimedStep& s) { return s.starts; }),
                                   mean([](const TimedStep& s) { return s.undecided; })};
  for (const auto& [name, field] : kCounterFields) {
    counts.emplace_back(mean([field = field](const TimedStep& s) { return s.counters.*field; }));
  }
  return counts;
}

/// Widths with equal counts at one tolerance share a row.
void addCounterRows(const RateTimes& at, BenchTable& table) {
  constexpr std::size_t kSimd = 2, kCounts = 3;  // columns
  const auto first = static_cast<std::ptrdiff_t>(table.rows.size());
  for (std::size_t c = 0; c < at.cases.size(); ++c) {
    const std::vector<BenchCell> counts = meanCounts(at.timing.cases[c]);
    const BenchCell tolerance = at.cases[c].query.tolerance;
    const std::string simd = vectorsOf(at.cases[c]);
    const auto same = std::find_if(
        table.rows.begin() + first, table.rows.end(), [&](const std::vector<BenchCell>& row) {
          return row[1] == tolerance &&
                 std::equal(counts.begin(), counts.end(), row.begin() + kCounts);
        });
    if (same != table.rows.end()) {
      std::get<std::string>((*same)[kSimd]) += ", " + simd;
      continue;
    }
    std::vector<BenchCell> row = {at.rateHz, tolerance, simd};
    row.insert(row.end(), counts.begin(), counts.end());
    table.rows.push_back(std::move(row));
  }
}

/// Each case against the first, and cold against warm.
void addRatioRows(const RateTimes& at, BenchTable& table) {
  const CaseTimes& base = at.timing.cases.front();
  const Percentiles warm = percentilesOf(column(base, warmOf));
  const auto add = [&](const std::string& what, double ratio) {
    table.rows.push_back({fmt::format("{:g} Hz: {}", at.rateHz, what), ratio});
  };
  for (std::size_t c = 1; c < at.cases.size(); ++c) {
    const Percentiles other = percentilesOf(column(at.timing.cases[c], warmOf));
    const std::string names = at.cases[c].name + " over " + at.cases.front().name;
    add(names + ", mean", other.mean / warm.mean);
    add(names + ", p99", other.p99 / warm.p99);
  }
  if (!at.cases.front().cold) return;
  const Percentiles cold = percentilesOf(column(base, [](const TimedStep& s) { return s.coldUs; }));
  add("cold over warm, p50", cold.p50 / warm.p50);
  add("cold over warm, p99", cold.p99 / warm.p99);
}

void addRawRows(const RateTimes& at, BenchTable& table) {
  for (std::size_t c = 0; c < at.cases.size(); ++c) {
    for (std::size_t i = 0; i < at.timing.cases[c].steps.size(); ++i) {
      const TimedStep& step = at.timing.cases[c].steps[i];
      const StepPick& pick = at.workload.picks[i];
      const Eigen::Vector3d& p = pick.placement.origin;
      std::vector<BenchCell> row = {at.rateHz,
                                    at.cases[c].query.tolerance,
                                    vectorsOf(at.cases[c]),
                                    static_cast<std::int64_t>(i),
                                    p.x(),
                                    p.y(),
                                    p.z(),
                                    pick.placement.yawDeg,
                                    pick.frame,
                                    step.onceUs,
                                    step.warmUs,
                                    step.firstUs,
                                    step.coldUs,
                                    at.timing.raySetUs[i],
                                    std::int64_t{step.contacts},
                                    std::int64_t{step.starts},
                                    std::int64_t{step.undecided}};
      for (const auto& [name, field] : kCounterFields) {
        row.emplace_back(static_cast<std::int64_t>(step.counters.*field));
      }
      table.rows.push_back(std::move(row));
    }
  }
}

/// The cases: every tolerance at the first width, and every width at the first tolerance; there
/// also with own links, if there are rules for them.
std::vector<BenchCase> casesOf(const LatencyRequest& request, const QueryOptions& query,
                               const std::optional<PairRules>& rules) {
  std::vector<BenchCase> cases;
  const auto add = [&](double tolerance, Simd simd) {
    BenchCase way;
    way.name = fmt::format("{:g} m {}", tolerance, toString(simd));
    way.query = query;
    way.reference = request.options.reference;
    way.query.tolerance = tolerance;
    way.simd = simd;
    way.cold = cases.empty() && request.options.timing.coldMb > 0;
    cases.push_back(std::move(way));
  };
  for (const double tolerance : request.tolerances) add(tolerance, request.widths.front());
  for (std::size_t i = 1; i < request.widths.size(); ++i) {
    add(request.tolerances.front(), request.widths[i]);
  }
  if (rules) {
    add(request.tolerances.front(), request.widths.front());
    cases.back().name += " with own links";
    cases.back().query.self = rules;
  }
  return cases;
}

std::vector<std::string> notesOn(const TimingOptions& timing, double overheadUs) {
  return {
      "A step is timed from two validated poses to the contacts of all links, building the motion "
      "included; one thread, memory reused.",
      fmt::format("asked once: every step singly, place by place in the order of the clip, after "
                  "{} KB of other memory; the least of {} passes over all steps. This is what a "
                  "live program pays.",
                  timing.betweenKb, timing.coldPasses),
      fmt::format("warm: the least of {} times in a row. first of all: the first of them, after "
                  "other steps. every repeat: all of them. cold: {} MB streamed through the caches "
                  "before the step, the least of {} passes. Less {:.3f} us for the clock.",
                  timing.repeats, timing.coldMb, timing.coldPasses, overheadUs),
      "A ray-set is 16 occlusion rays along the links' ways; its time here is the median over the "
      "same steps, taken in turns with them."};
}

/// Pairs of own links that touch in nearly all steps' poses are left out.
Result<PairRules> rulesFor(const Avatar& avatar, const std::vector<StepPoses>& steps) {
  std::vector<Pose> poses;
  for (const StepPoses& step : steps) poses.push_back(step.from);
  PairRuleOptions options;
  options.usualPoses = &poses;
  return PairRules::derive(avatar, options);
}

BenchReport latencyReport(const LatencyRequest& request, const BenchInputs& inputs,
                          const Scene& scene, const Avatar& avatar, const QueryOptions& query) {
  BenchReport report = startedReport(
      "latency",
      fmt::format("Latency of a step: {} in {} triangles, {} links, {} fidelity",
                  fileName(inputs.files.scenePath), scene.numTriangles(), avatar.numLinks(),
                  fidelityWord(query.fidelity, request.options.reference)));
  report.workload = workloadFacts(inputs, scene, avatar, query, request.options.reference);
  report.tables = {latencyTable(), ratiosTable(), countersTable()};
  return report;
}

}  // namespace

Result<MeasuredBench> measureLatency(const LatencyRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.options.files));
  FORETOUCH_TRY(const auto scene, refinedScene(inputs, request.triangles));
  FORETOUCH_TRY(const auto body, bodyOf(inputs, request.links));
  FORETOUCH_TRY(const auto query, queryFor(inputs, body, request.options));

  MeasuredBench bench{latencyReport(request, inputs, scene, body.avatar, query), rawTable()};
  BenchReport& report = bench.report;
  double overheadUs = 0.0;
  for (const double rateHz : request.ratesHz) {
    WorkloadRequest wanted = request.options.workload;
    wanted.rateHz = rateHz;
    FORETOUCH_TRY(const auto workload, chooseSteps(inputs, body, wanted));
    FORETOUCH_TRY(const auto steps, posesOf(inputs, body, workload));
    std::optional<PairRules> rules;
    if (request.self) {
      FORETOUCH_TRY(rules, rulesFor(body.avatar, steps));
    }
    const std::vector<BenchCase> cases = casesOf(request, query, rules);
    const auto timing =
        timeSteps(body.avatar, steps, inClipOrder(workload), scene, cases, request.options.timing);
    if (!timing.ok()) return timing.error();
    const RateTimes at{rateHz, workload, cases, timing.value()};
    report.workload.emplace_back(fmt::format("at {:g} Hz", rateHz), describe(workload));
    addLatencyRows(at, report.tables[0]);
    addRatioRows(at, report.tables[1]);
    addCounterRows(at, report.tables[2]);
    addRawRows(at, bench.raw);
    overheadUs = timing.value().overheadUs;
  }
  if (report.tables[1].rows.empty()) report.tables.erase(report.tables.begin() + 1);
  report.notes = notesOn(request.options.timing, overheadUs);
  return bench;
}

namespace {

ExitCode run(LatencyRequest& request) {
  FORETOUCH_CHECK_OR(failed, complete(request.options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureLatency(request));
  return finished(bench.report, bench.raw, request.options.figures);
}

}  // namespace

Command latencyCommand() {
  constexpr int kMaxColdMb = 1024;
  const auto request = std::make_shared<LatencyRequest>();
  request->ratesHz = {5, 10, 30};
  request->tolerances = {1e-3, 1e-5};
  Settings settings;
  addNumbers(settings, "--rate", "HZ,...", request->ratesHz, kAboveZero, "Poses a second");
  addNumbers(settings, "--tolerance", "M,...", request->tolerances, kToleranceRange,
             "Tolerances (m)");
  addSimds(settings, "--simd", request->widths, "Vector instructions: their names, all or widest");
  addLinks(settings, "--links", request->links);
  addTriangles(settings, "--triangles", request->triangles);
  settings.whole("--cold-mb", "MB", request->options.timing.coldMb, 0, kMaxColdMb,
                 "Streamed through the caches before a cold step; 0: none");
  settings.flag("--self", request->self,
                "Also with the avatar's own links, by rules from these steps' poses");
  addBenchOptions(settings, request->options);
  Command command{
      "latency", "How long a step takes, and how many sets of 16 rays that is",
      "Example:\n  foretouch-bench latency --triangles 300000 --links 16 --json latency.json",
      std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
