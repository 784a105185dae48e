// bench/trees.cpp: `foretouch-bench trees`: the builders of a scene's tree beside one another.
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/latency.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/scene.h"
#include "middleware/scene/bvh_tree.h"
#include "middleware/scene/scene_parts.h"
#include "tools/report/document_parts.h"

namespace foretouch::tools {
namespace {

struct TreesRequest {
  BenchOptions options;
  std::size_t triangles = 300'000;  ///< 0: the scene's own.
  int rounds = 5;  ///< Each builder once, in turns; the least of a builder's times counts.
};

using internal::TreeBuilder;

/// The library's own choice again, however measuring ends.
struct BuilderAfterwards {
  BuilderAfterwards() = default;
  BuilderAfterwards(const BuilderAfterwards&) = delete;
  BuilderAfterwards& operator=(const BuilderAfterwards&) = delete;
  ~BuilderAfterwards() { internal::useTreeBuilder(std::nullopt); }
};

struct BuilderTimes {
  TreeBuilder builder;
  double treeMs = std::numeric_limits<double>::infinity();
  double sceneMs = std::numeric_limits<double>::infinity();
  double stepUs = std::numeric_limits<double>::infinity();
  std::uint32_t nodes = 0, leaves = 0;
};

template <typename Work>
double msOf(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

/// What is asked of every builder's tree.
struct Asked {
  RawScene raw;
  Avatar avatar;
  std::vector<StepPoses> steps;
  std::vector<std::size_t> clipOrder;
  std::vector<BenchCase> cases;
};

/// One round of one builder.
Result<BuilderTimes> measureOnce(TreeBuilder builder, const Asked& asked,
                                 const TimingOptions& timing) {
  internal::useTreeBuilder(builder);
  BuilderTimes times{builder};
  RawScene raw = asked.raw;
  std::optional<Result<Scene>> scene;
  times.sceneMs = msOf([&] { scene = Scene::build(std::move(raw)); });
  FORETOUCH_TRY(const auto built, std::move(*scene));
  const internal::SceneParts& parts = built.parts();
  const std::vector<Triangle> triangles(parts.triangles.begin(), parts.triangles.end());
  const std::vector<TriangleId> ids = parts.finiteIds();
  std::optional<Result<internal::FlatBvh>> tree;
  const Aabb box{parts.audit.boxMin, parts.audit.boxMax};
  times.treeMs = msOf([&] { tree = internal::FlatBvh::build(triangles, ids, box, parts.origin); });
  times.nodes = parts.bvh.numNodes();
  times.leaves = parts.bvh.numLeaves();
  FORETOUCH_TRY(const auto timed,
                timeSteps(asked.avatar, asked.steps, asked.clipOrder, built, asked.cases, timing));
  double sumUs = 0.0;
  for (const TimedStep& step : timed.cases.front().steps) sumUs += step.warmUs;
  times.stepUs = sumUs / static_cast<double>(asked.steps.size());
  return times;
}

BenchTable treesTable(const std::vector<BuilderTimes>& builders) {
  BenchTable table{"trees",
                   "A scene's tree, its copy included, and steps of an avatar in it",
                   {{"builder", "builder", 0},
                    {"tree_ms", "tree ms", 1},
                    {"scene_ms", "scene ms", 1},
                    {"step_us", "step us", 2},
                    {"nodes", "nodes", 0},
                    {"leaves", "leaves", 0},
                    {"tree_ratio", "tree/first", 2},
                    {"step_ratio", "step/first", 3}},
                   {}};
  const BuilderTimes& first = builders.front();
  for (const BuilderTimes& times : builders) {
    table.rows.push_back({std::string(internal::toString(times.builder)), times.treeMs,
                          times.sceneMs, times.stepUs, std::int64_t{times.nodes},
                          std::int64_t{times.leaves}, times.treeMs / first.treeMs,
                          times.stepUs / first.stepUs});
  }
  return table;
}

/// Table "trees": one row per builder of this library. Raw: one line per round and builder.
Result<MeasuredBench> measureTrees(const TreesRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.options.files));
  FORETOUCH_TRY(const auto body, bodyOf(inputs, 0));
  FORETOUCH_TRY(const auto query, queryFor(inputs, body, request.options));
  FORETOUCH_TRY(const auto workload, chooseSteps(inputs, body, request.options.workload));
  FORETOUCH_TRY(auto steps, posesOf(inputs, body, workload));
  BenchCase way;
  way.name = "widest";
  way.query = query;
  way.reference = request.options.reference;
  way.simd = supportedSimd().back();
  const std::size_t triangles =
      request.triangles > 0 ? request.triangles : inputs.raw.triangles.size();
  const Asked asked{subdivided(inputs.raw, triangles),
                    body.avatar,
                    std::move(steps),
                    inClipOrder(workload),
                    {way}};

  const BuilderAfterwards guard;
  std::vector<BuilderTimes> best;
  MeasuredBench bench;
  bench.raw = {"rounds",
               "Every round",
               {{"round", "round", 0},
                {"builder", "builder", 0},
                {"tree_ms", "tree ms", 1},
                {"scene_ms", "scene ms", 1},
                {"step_us", "step us", 2}},
               {}};
  for (const TreeBuilder builder : internal::treeBuilders()) best.push_back({builder});
  for (int round = 0; round < request.rounds; ++round) {
    for (BuilderTimes& least : best) {
      FORETOUCH_TRY(const auto times, measureOnce(least.builder, asked, request.options.timing));
      bench.raw.rows.push_back({std::int64_t{round}, std::string(internal::toString(times.builder)),
                                times.treeMs, times.sceneMs, times.stepUs});
      least.treeMs = std::min(least.treeMs, times.treeMs);
      least.sceneMs = std::min(least.sceneMs, times.sceneMs);
      least.stepUs = std::min(least.stepUs, times.stepUs);
      least.nodes = times.nodes;
      least.leaves = times.leaves;
    }
  }
  BenchReport& report = bench.report;
  report = startedReport("trees",
                         fmt::format("Builders of a scene's tree: {} in {} triangles",
                                     fileName(inputs.files.scenePath), asked.raw.triangles.size()));
  report.workload = {{"steps", describe(workload)}};
  report.tables = {treesTable(best)};
  report.notes = {fmt::format("The least of {} rounds, the builders in turns. tree: from triangles "
                              "in order to the flat tree. scene: all of Scene::build().",
                              request.rounds),
                  "embree uses all cores, binned one."};
  return bench;
}

ExitCode run(TreesRequest& request) {
  FORETOUCH_CHECK_OR(failed, complete(request.options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrees(request));
  return finished(bench.report, bench.raw, request.options.figures);
}

}  // namespace

Command treesCommand() {
  constexpr int kMaxRounds = 1000;
  const auto request = std::make_shared<TreesRequest>();
  Settings settings;
  addTriangles(settings, "--triangles", request->triangles);
  settings.whole("--rounds", "N", request->rounds, 1, kMaxRounds, "How often each builder builds");
  addBenchOptions(settings, request->options);
  Command command{
      "trees", "The builders of a scene's tree: how long they take, and how good their trees are",
      "Example:\n  foretouch-bench trees --triangles 300000 --json trees.json",
      std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
