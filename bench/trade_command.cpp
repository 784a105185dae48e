#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/options.h"
#include "bench/trade.h"
#include "bench/trade/trade_tables.h"
#include "tools/results_output.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedTrade {
  TradeRequest request;
  std::vector<std::string> scenes, clips;  ///< Empty: the bundled one.
  std::vector<double> sceneScales{1.0}, clipScales{1.0};
  std::vector<UpAxis> sceneUps{UpAxis::Y}, clipUps{UpAxis::Y};
  std::optional<int> processor;
  FigureFiles figures;
  std::string markdown;
  bool quick = false;
};

/// Short lists where the command line has none.
void makeQuick(const Settings& settings, TradeRequest& request) {
  const auto quick = [&](const char* option, auto& place, auto value) {
    if (!settings.isGiven(option)) place = std::move(value);
  };
  quick("--tolerance", request.tolerances, std::vector<double>{1e-2, 1e-3, 1e-5});
  quick("--rate", request.ratesHz, std::vector<double>{5, 30});
  quick("--seconds", request.seconds, 2.0);
  quick("--places", request.places, 1);
  quick("--passes", request.passes, 2);
}

/// One value for all of `count` files, or one per file.
template <typename T>
Result<std::vector<T>> oneEach(const std::string& option, std::vector<T> values,
                               std::size_t count) {
  if (values.size() == 1) values.resize(count, values.front());
  if (values.size() == count) return values;
  return Error::in(option, ErrorCode::Mismatch,
                   fmt::format("expected one value, or one for each of {} files, found {}", count,
                               values.size()));
}

/// The one of `values` nearest to `wanted` by ratio.
double nearestOf(const std::vector<double>& values, double wanted) {
  return *std::min_element(values.begin(), values.end(), [&](double x, double y) {
    return std::max(x / wanted, wanted / x) < std::max(y / wanted, wanted / y);
  });
}

Result<Done> addWorlds(AskedTrade& asked) {
  std::vector<std::string> scenes = asked.scenes, clips = asked.clips;
  if (scenes.empty()) scenes = {""};
  if (clips.empty()) clips = {""};
  FORETOUCH_TRY(const auto sceneScales,
                oneEach("--scene-scales", asked.sceneScales, scenes.size()));
  FORETOUCH_TRY(const auto sceneUps, oneEach("--scene-ups", asked.sceneUps, scenes.size()));
  FORETOUCH_TRY(const auto clipScales, oneEach("--clip-scales", asked.clipScales, clips.size()));
  FORETOUCH_TRY(const auto clipUps, oneEach("--clip-ups", asked.clipUps, clips.size()));
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (std::size_t clip = 0; clip < clips.size(); ++clip) {
      BenchFiles files;
      files.scenePath = scenes[scene];
      files.sceneScale = sceneScales[scene];
      files.sceneUp = sceneUps[scene];
      files.motionPath = clips[clip];
      files.motionScale = clipScales[clip];
      files.motionUp = clipUps[clip];
      asked.request.worlds.push_back(std::move(files));
    }
  }
  return Done{};
}

Result<Done> checkTolerances(const std::vector<double>& tolerances) {
  for (const double tolerance : tolerances) {
    if (tolerance >= kTruthTolerance) continue;
    return Error::in("--tolerance", ErrorCode::OutOfRange,
                     fmt::format("expected {:g} m or more, where the truth is known, found {:g}",
                                 kTruthTolerance, tolerance));
  }
  return Done{};
}

Result<Done> complete(const Settings& settings, AskedTrade& asked) {
  constexpr std::size_t kWorkloadSteps = 60;
  constexpr int kWorkloadPlaces = 200;
  constexpr double kBaseTolerance = 1e-3, kBaseRateHz = 5.0;
  TradeRequest& request = asked.request;
  if (asked.quick) makeQuick(settings, request);
  FORETOUCH_CHECK(addWorlds(asked));
  FORETOUCH_CHECK(checkTolerances(request.tolerances));
  for (const std::string& output : {asked.figures.json, asked.figures.csv, asked.markdown}) {
    FORETOUCH_CHECK(checkIsNoInput(output, asked.scenes));
    FORETOUCH_CHECK(checkIsNoInput(output, asked.clips));
  }
  request.workload.steps = kWorkloadSteps;
  request.workload.mostPlacements = kWorkloadPlaces;
  request.baseTolerance = nearestOf(request.tolerances, kBaseTolerance);
  request.baseRateHz = nearestOf(request.ratesHz, kBaseRateHz);
  return keepTo(asked.processor);
}

Result<Done> writeAll(const AskedTrade& asked, const MeasuredTrade& bench) {
  const BenchTable raw = tradeTable(bench.rows, "rows", "Everything that was measured");
  BenchReport whole = bench.report;
  whole.tables.push_back(raw);
  FORETOUCH_CHECK(writeReport(whole, raw, asked.figures));
  return writeText(asked.markdown, reportMarkdown(bench.report));
}

ExitCode run(const Settings& settings, AskedTrade& asked) {
  FORETOUCH_CHECK_OR(failed, complete(settings, asked));
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrade(asked.request));
  FORETOUCH_CHECK_OR(failed, writeAll(asked, bench));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

void addFiles(Settings& settings, AskedTrade& asked) {
  addWords(settings, "--scenes", "FILE,...", asked.scenes, {},
           "Scenes; the bundled room if not given");
  addWords(settings, "--clips", "FILE,...", asked.clips, {}, "Clips; the bundled one if not given");
  addNumbers(settings, "--scene-scales", "S,...", asked.sceneScales, kMetresPerUnit,
             "Metres per unit, one for all or one each");
  addNumbers(settings, "--clip-scales", "S,...", asked.clipScales, kMetresPerUnit,
             "Of the clips, one for all or one each")
      .formerly("--scales");
  addUpAxes(settings, "--scene-ups", "y|z,...", asked.sceneUps,
            "Up axes of scenes, one for all or one each");
  addUpAxes(settings, "--clip-ups", "y|z,...", asked.clipUps,
            "Up axes of clips, one for all or one each")
      .formerly("--ups");
}

void addEffort(Settings& settings, TradeRequest& request) {
  constexpr int kMaxSeed = 1'000'000'000, kMostPlaces = 1000, kMostJudged = 100'000;
  request.tolerances = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  request.ratesHz = {1, 5, 10, 30, 60, 120};
  addNumbers(settings, "--tolerance", "M,...", request.tolerances, kToleranceRange,
             "Tolerances (m)");
  addNumbers(settings, "--rate", "HZ,...", request.ratesHz, kAboveZero, "Poses a second");
  settings.number("--seconds", "S", request.seconds, kAboveZero, "Of the clip at each place");
  settings.whole("--places", "N", request.places, 1, kMostPlaces,
                 "Places with contacts in each scene");
  settings.whole("--passes", "N", request.passes, 1, kMaxBenchRepeats,
                 "Of every strategy; a step's least time counts");
  settings.whole("--judged", "N", request.judged, 1, kMostJudged,
                 "Links per scene and clip that an independent judge checks");
  addFloor(settings, request.workload);
  settings.whole("--seed", "N", request.workload.seed, 1, kMaxSeed, "Of the places");
  settings.whole("--surface-triangles", "N", request.surfaceTriangles, 1, kMaxBenchTriangles,
                 "Of an avatar without meshes, at exact fidelity: the skins of its LSS");
}

constexpr char kFooter[] =
    R"(Every clip in every scene, at every rate that it has, at every tolerance, by every strategy.
Examples:
  foretouch-bench trade --quick --markdown trade.md
  foretouch-bench trade --clips walk.bvh,kick.bvh --clip-scales 0.01 --scenes room.obj,kitchen.ply --scene-ups y,z \
      --json trade.json --csv trade.csv --markdown trade.md)";

}  // namespace

Command tradeCommand() {
  const auto asked = std::make_shared<AskedTrade>();
  Settings settings;
  addFiles(settings, *asked);
  addEffort(settings, asked->request);
  addProcessor(settings, asked->processor);
  addFigures(settings, asked->figures, "Also write one line per setting to a file");
  settings.output("--markdown", "FILE", asked->markdown, "Also write the tables as Markdown");
  settings.flag("--quick", asked->quick, "Few values and steps: a trial of seconds");
  Command command{
      "trade", "What speed costs in accuracy: strategies, tolerances and rates against the truth",
      kFooter, std::move(settings)};
  command.run = [asked](const Settings& given) { return run(given, *asked); };
  return command;
}

}  // namespace foretouch::tools
