// bench/scaling.cpp: `foretouch-bench scaling`: how the cost of a step grows with each parameter.
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/latency.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/pool.h"
#include "lss/index.h"
#include "middleware/contact.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// Varies one axis at a time; the others keep the base's value. An empty list omits its axis.
struct ScalingRequest {
  BenchOptions options;
  std::size_t triangles = 300'000;  ///< Of the base; 0: the scene's own.
  int links = 16;                   ///< Of the base; 0: the avatar's own.
  double tolerance = 1e-3;          ///< Of the base (m).
  double rateHz = 5.0;              ///< Of the base.
  std::vector<int> trianglesAxis, linksAxis;
  std::vector<double> rateAxis, toleranceAxis;
  std::vector<int> avatarsAxis, threadsAxis;  ///< Crossed with each other.
  int crowdSteps = 4000;                      ///< For all avatars together, at least.
  int crowdRepeats = 3;                       ///< The quickest counts.
};

BenchTable scalingTable() {
  BenchTable table{"scaling",
                   "Cost of a step, one thing varied at a time: microseconds, and in ray-sets",
                   {{"axis", "axis", 0},
                    {"value", "value", -1},
                    {"triangles", "triangles", 0},
                    {"links", "links", 0},
                    {"lss", "LSS", 0},
                    {"steps", "steps", 0},
                    {"contact_steps_percent", "contact %", 1},
                    {"mean_us", "mean", 2},
                    {"p50_us", "p50", 2},
                    {"p99_us", "p99", 2},
                    {"ray_set_us", "ray-set", 3},
                    {"mean_ray_sets", "mean/rays", 1},
                    {"p50_ray_sets", "p50/rays", 1},
                    {"p99_ray_sets", "p99/rays", 1},
                    {"mean_over_base", "mean/base", 2}},
                   {}};
  for (const auto& [name, field] : kCounterFields) table.columns.push_back({name, name, 1});
  return table;
}

BenchTable crowdTable() {
  return {"crowd",
          "Many avatars in one scene: steps a second",
          {{"avatars", "avatars", 0},
           {"threads", "threads", 0},
           {"steps", "steps", 0},
           {"contacts", "contacts", 0},
           {"steps_per_s", "steps/s", 0},
           {"over_one_thread", "over 1 thread", 2},
           {"instant_p50_us", "all avatars, p50 us", 1},
           {"instant_p99_us", "p99 us", 1}},
          {}};
}

BenchTable rawTable() {
  return {"steps",
          "Steps",
          {{"axis", "axis", 0},
           {"value", "value", -1},
           {"step", "step", 0},
           {"warm_us", "warm", 3},
           {"ray_set_us", "ray-set", 3},
           {"contacts", "contacts", 0},
           {"starts", "starts", 0}},
          {}};
}

/// The parameters of one row.
struct Point {
  const char* axis;
  double value;
  std::size_t triangles;
  int links;
  double rateHz;
  double tolerance;
};

class ScalingBench {
 public:
  ScalingBench(const ScalingRequest& request, const BenchInputs& inputs)
      : request_(request), inputs_(inputs), scene_(inputs.scene) {
    bench_.report = startedReport("scaling", "Scaling");
    bench_.report.tables = {scalingTable()};
    bench_.raw = rawTable();
  }

  [[nodiscard]] Result<MeasuredBench> run();

 private:
  [[nodiscard]] Point basePoint(const char* axis) const {
    return {axis, 0.0, request_.triangles, request_.links, request_.rateHz, request_.tolerance};
  }
  /// The base again, then one row per value: the machine may have drifted since the last axis.
  template <typename Value, typename Set>
  [[nodiscard]] Result<Done> axis(const char* name, const std::vector<Value>& values,
                                  double baseValue, const Set& set);
  [[nodiscard]] Result<double> row(const Point& point, double baseMeanUs);
  [[nodiscard]] Result<Done> prepare(const Point& point);
  void addRow(const Point& point, const Timing& timing, double baseMeanUs);
  [[nodiscard]] Result<Done> crowd();
  [[nodiscard]] Result<CrowdTimes> quickestCrowd(int avatars, int threads,
                                                 const QueryOptions& query);

  const ScalingRequest& request_;
  const BenchInputs& inputs_;
  MeasuredBench bench_;
  // The last row's scene and body, kept if the next row uses the same.
  Scene scene_;
  std::size_t sceneTriangles_ = 0;
  std::optional<BenchBody> body_;
  int bodyLinks_ = -1;
  QueryOptions query_;
  std::optional<Workload> workload_;
  std::vector<StepPoses> steps_;
};

Result<Done> ScalingBench::prepare(const Point& point) {
  if (sceneTriangles_ != point.triangles) {
    scene_ = inputs_.scene;  // never two refined scenes in memory
    FORETOUCH_TRY(scene_, refinedScene(inputs_, point.triangles));
    sceneTriangles_ = point.triangles;
  }
  const bool newBody = bodyLinks_ != point.links;
  if (newBody) {
    FORETOUCH_TRY(body_, bodyOf(inputs_, point.links));
    bodyLinks_ = point.links;
    FORETOUCH_TRY(query_, queryFor(inputs_, *body_, request_.options));
  }
  const bool newSteps = !workload_ || workload_->request.rateHz != point.rateHz;
  if (newSteps) {
    WorkloadRequest wanted = request_.options.workload;
    wanted.rateHz = point.rateHz;
    const auto base = bodyOf(inputs_, request_.links);  // the same steps for every body
    if (!base.ok()) return base.error();
    FORETOUCH_TRY(workload_, chooseSteps(inputs_, base.value(), wanted));
  }
  if (!newBody && !newSteps) return Done{};
  FORETOUCH_TRY(steps_, posesOf(inputs_, *body_, *workload_));
  return Done{};
}

void ScalingBench::addRow(const Point& point, const Timing& timing, double baseMeanUs) {
  const std::vector<TimedStep>& steps = timing.cases.front().steps;
  const auto count = static_cast<double>(steps.size());
  std::vector<double> us;
  double contactSteps = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    us.push_back(steps[i].warmUs);
    contactSteps += steps[i].contacts > 0 ? 1.0 : 0.0;
    bench_.raw.rows.push_back({std::string(point.axis), point.value, static_cast<std::int64_t>(i),
                               steps[i].warmUs, timing.raySetUs[i], std::int64_t{steps[i].contacts},
                               std::int64_t{steps[i].starts}});
  }
  const Percentiles p = percentilesOf(std::move(us));
  const double rays = percentilesOf(timing.raySetUs).p50;
  std::vector<BenchCell> row = {std::string(point.axis),
                                point.value,
                                static_cast<std::int64_t>(scene_.numTriangles()),
                                std::int64_t{body_->avatar.numLinks()},
                                std::int64_t{body_->avatar.numLss()},
                                static_cast<std::int64_t>(steps.size()),
                                100.0 * contactSteps / count,
                                p.mean,
                                p.p50,
                                p.p99,
                                rays,
                                p.mean / rays,
                                p.p50 / rays,
                                p.p99 / rays,
                                baseMeanUs > 0.0 ? p.mean / baseMeanUs : 1.0};
  for (const auto& [name, field] : kCounterFields) {
    double sum = 0.0;
    for (const TimedStep& step : steps) sum += static_cast<double>(step.counters.*field);
    row.emplace_back(sum / count);
  }
  bench_.report.tables.front().rows.push_back(std::move(row));
}

/// The mean of the row's steps.
Result<double> ScalingBench::row(const Point& point, double baseMeanUs) {
  FORETOUCH_CHECK(prepare(point));
  BenchCase way;
  way.query = query_;
  way.reference = request_.options.reference;
  way.query.tolerance = point.tolerance;
  way.simd = supportedSimd().back();
  FORETOUCH_TRY(const auto timing,
                timeSteps(body_->avatar, steps_, {}, scene_, {way}, request_.options.timing));
  addRow(point, timing, baseMeanUs);
  double sum = 0.0;
  for (const TimedStep& step : timing.cases.front().steps) sum += step.warmUs;
  return sum / static_cast<double>(steps_.size());
}

template <typename Value, typename Set>
Result<Done> ScalingBench::axis(const char* name, const std::vector<Value>& values,
                                double baseValue, const Set& set) {
  if (values.empty()) return Done{};
  Point base = basePoint(name);
  base.value = baseValue;
  FORETOUCH_TRY(const auto baseMeanUs, row(base, 0.0));
  for (const Value value : values) {
    if (static_cast<double>(value) == baseValue) continue;
    Point point = basePoint(name);
    point.value = static_cast<double>(value);
    set(point, value);
    FORETOUCH_CHECK(row(point, baseMeanUs));
  }
  return Done{};
}

Result<CrowdTimes> ScalingBench::quickestCrowd(int avatars, int threads,
                                               const QueryOptions& query) {
  const int instants = std::max(1, (request_.crowdSteps + avatars - 1) / avatars);
  std::optional<CrowdTimes> quickest;
  for (int repeat = 0; repeat < request_.crowdRepeats; ++repeat) {
    FORETOUCH_TRY(auto times,
                  timeCrowd(body_->avatar, steps_, scene_, query, avatars, instants, threads));
    if (!quickest || times.wallS < quickest->wallS) quickest = std::move(times);
  }
  return *quickest;
}

Result<Done> ScalingBench::crowd() {
  if (request_.avatarsAxis.empty() || request_.threadsAxis.empty()) return Done{};
  FORETOUCH_CHECK(prepare(basePoint("crowd")));
  QueryOptions query = query_;
  query.tolerance = request_.tolerance;
  BenchTable table = crowdTable();
  for (const int avatars : request_.avatarsAxis) {
    double oneThread = std::numeric_limits<double>::quiet_NaN();
    for (const int threads : request_.threadsAxis) {
      FORETOUCH_TRY(const auto times, quickestCrowd(avatars, threads, query));
      const double perS = static_cast<double>(times.steps) / times.wallS;
      if (threads == 1) oneThread = perS;
      const Percentiles p = percentilesOf(times.instantUs);
      table.rows.push_back({std::int64_t{avatars}, std::int64_t{threads}, times.steps,
                            times.contacts, perS, perS / oneThread, p.p50, p.p99});
    }
  }
  bench_.report.tables.push_back(std::move(table));
  return Done{};
}

Result<MeasuredBench> ScalingBench::run() {
  BenchReport& report = bench_.report;
  const auto setTriangles = [](Point& p, int n) { p.triangles = countOf(n); };
  const double baseTriangles =
      static_cast<double>(std::max(request_.triangles, inputs_.raw.triangles.size()));
  const double baseLinks = request_.links == 0 ? inputs_.avatar.numLinks() : request_.links;
  for (const Result<Done>&done :
       {axis("links", request_.linksAxis, baseLinks, [](Point&p, int n) { p.links = n; }),
        axis("rate Hz", request_.rateAxis, request_.rateHz,
             [](Point&p, double rate) { p.rateHz = rate; }),
        axis("tolerance m", request_.toleranceAxis, request_.tolerance,
             [](Point&p, double tolerance) { p.tolerance = tolerance; }),
        crowd(), axis("triangles", request_.trianglesAxis, baseTriangles, setTriangles)}) {
    if (!done.ok()) return done.error();
  }
  FORETOUCH_CHECK(prepare(basePoint("base")));
  report.workload =
      workloadFacts(inputs_, scene_, body_->avatar, query_, request_.options.reference);
  report.workload.emplace_back(fmt::format("at {:g} Hz", request_.rateHz), describe(*workload_));
  report.notes = {
      fmt::format("The first row of each axis is the base, measured anew: {:g} triangles, {:g} "
                  "links, {:g} Hz, {:g} m. mean/base compares with it.",
                  baseTriangles, baseLinks, request_.rateHz, request_.tolerance),
      fmt::format(
          "A step's time is the least of {} in a row, one thread, {} vectors. Steps are the "
          "same ones on every axis but rate; links that are grown may add contacts.",
          request_.options.timing.repeats, toString(supportedSimd().back())),
      "A scene is never made coarser: where fewer triangles are asked for, the column says how "
      "many "
      "there were."};
  if (report.tables.size() > 1) {
    report.notes.push_back(fmt::format(
        "Crowd: every avatar takes one step an instant, threads share the (instant, avatar) items; "
        "the quickest of {} runs.",
        request_.crowdRepeats));
  }
  return std::move(bench_);
}

/// Tables: "scaling", and "crowd" if there are avatars and threads.
Result<MeasuredBench> measureScaling(const ScalingRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.options.files));
  return ScalingBench(request, inputs).run();
}

struct AskedScaling {
  ScalingRequest request;
  bool quick = false;
};

/// Short lists where the command line has none, and few steps.
void makeQuick(const Settings& settings, ScalingRequest& request) {
  constexpr int kQuickSteps = 40, kQuickRepeats = 2, kQuickCrowd = 60;
  const auto quick = [&](const char* option, auto& place, auto values) {
    if (!settings.isGiven(option)) place = std::move(values);
  };
  quick("--triangles", request.trianglesAxis, std::vector<int>{});
  quick("--links", request.linksAxis, std::vector<int>{8, 16});
  quick("--rate", request.rateAxis, std::vector<double>{10});
  quick("--tolerance", request.toleranceAxis, std::vector<double>{1e-5});
  quick("--avatars", request.avatarsAxis, std::vector<int>{3});
  quick("--base-triangles", request.triangles, std::size_t{0});
  request.options.workload.steps =
      std::min<std::size_t>(request.options.workload.steps, kQuickSteps);
  request.options.timing.repeats = kQuickRepeats;
  request.crowdSteps = kQuickCrowd;
}

ExitCode run(const Settings& settings, AskedScaling& asked) {
  if (asked.quick) makeQuick(settings, asked.request);
  FORETOUCH_CHECK_OR(failed, complete(asked.request.options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureScaling(asked.request));
  return finished(bench.report, bench.raw, asked.request.options.figures);
}

void addAxes(Settings& settings, ScalingRequest& request) {
  request.trianglesAxis = {10'000, 300'000, 1'000'000, 3'000'000, 10'000'000};
  request.linksAxis = {1, 4, 16, 31, 64, 128};
  request.rateAxis = {1, 5, 10, 30};
  request.toleranceAxis = {1e-2, 1e-3, 1e-4, 1e-5};
  request.avatarsAxis = {1, 10, 100};
  request.threadsAxis = {1, 2};
  const auto counts = [&](const char* option, std::vector<int>& place, int most, const char* help) {
    orNone(addCounts(settings, option, "N,...", place, most, help), place);
  };
  const auto numbers = [&](const char* option, const char* value, std::vector<double>& place,
                           NumberRange range, const char* help) {
    orNone(addNumbers(settings, option, value, place, range, help), place);
  };
  counts("--triangles", request.trianglesAxis, kMaxBenchTriangles,
         "Triangles that the scene is divided into");
  counts("--links", request.linksAxis, kMaxBenchLinks, "Links: fewer are cut off, more are grown");
  numbers("--rate", "HZ,...", request.rateAxis, kAboveZero, "Poses a second");
  numbers("--tolerance", "M,...", request.toleranceAxis, kToleranceRange, "Tolerances (m)");
  counts("--avatars", request.avatarsAxis, kMaxBenchAvatars, "Avatars in the scene at once");
  counts("--threads", request.threadsAxis, kMaxThreads, "Threads that answer them");
}

constexpr char kFooter[] =
    R"(An axis of `none` is left out. The base is what stays while one axis is varied.
Examples:
  foretouch-bench scaling --quick
  foretouch-bench scaling --triangles 300000,3000000 --links 16,64 --json scaling.json)";

}  // namespace

Command scalingCommand() {
  const auto asked = std::make_shared<AskedScaling>();
  ScalingRequest& request = asked->request;
  Settings settings;
  addAxes(settings, request);
  constexpr char kBase[] = "While other things are varied";
  settings.wholeOr("own", "--base-triangles", "N|own", request.triangles, kMaxBenchTriangles,
                   kBase);
  settings.wholeOr("own", "--base-links", "N|own", request.links, kMaxBenchLinks, kBase);
  settings.number("--base-rate", "HZ", request.rateHz, kAboveZero, kBase);
  settings.number("--base-tolerance", "M", request.tolerance, kToleranceRange, kBase);
  settings.flag("--quick", asked->quick, "Few values and steps: a trial of seconds");
  addBenchOptions(settings, request.options);
  Command command{"scaling",
                  "How a step's cost grows with triangles, links, motion, tolerance and avatars",
                  kFooter, std::move(settings)};
  command.run = [asked](const Settings& given) { return run(given, *asked); };
  return command;
}

}  // namespace foretouch::tools
