#include "bench/trade_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/trade.h"
#include "bench/trade/trade_page.h"
#include "bench/trade/trade_tables.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct TradeTexts {
  std::string scenes, clips, sceneScales = "1", scales = "1", sceneUps = "y", clipUps = "y";
  std::string tolerances, rates, seconds, places, passes, judged = "40";
  std::string floor = "0", lift = "0.05", seed = "1", processor = "any";
  std::string surfaceTriangles = "20000";
  std::string json, csv, html, markdown;
  bool quick = false;
};

/// Short lists for a quick run.
void fillIn(TradeTexts& texts) {
  const auto usual = [&](std::string& text, const char* full, const char* quick) {
    if (text.empty()) text = texts.quick ? quick : full;
  };
  usual(texts.tolerances, "0.1,0.01,0.001,0.0001,0.00001,0.000001,0.0000001", "0.01,0.001,0.00001");
  usual(texts.rates, "1,5,10,30,60,120", "5,30");
  usual(texts.seconds, "4", "2");
  usual(texts.places, "3", "1");
  usual(texts.passes, "3", "2");
}

/// The comma-separated files; by default the bundled one.
Result<std::vector<std::string>> parseFiles(const std::string& option, const std::string& names) {
  std::vector<std::string> files =
      names.empty() ? std::vector<std::string>{""} : splitAtCommas(names);
  if (names.empty() || std::find(files.begin(), files.end(), "") == files.end()) return files;
  return Error::in(option, ErrorCode::Empty, "expected a file between every two commas");
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

Result<std::vector<double>> parseScales(const std::string& option, const std::string& text,
                                        std::size_t count) {
  FORETOUCH_TRY(auto scales, parsePositives(option, text));
  return oneEach(option, std::move(scales), count);
}

Result<std::vector<UpAxis>> parseUpAxes(const std::string& option, const std::string& text,
                                        std::size_t count) {
  std::vector<UpAxis> axes;
  for (const std::string& word : splitAtCommas(text)) {
    FORETOUCH_TRY(const auto axis, parseUpAxis(option, word));
    axes.push_back(axis);
  }
  return oneEach(option, std::move(axes), count);
}

/// The one of `values` nearest to `wanted` by ratio.
double nearestOf(const std::vector<double>& values, double wanted) {
  return *std::min_element(values.begin(), values.end(), [&](double x, double y) {
    return std::max(x / wanted, wanted / x) < std::max(y / wanted, wanted / y);
  });
}

void settleWorlds(const TradeTexts& texts, Settling& settle, TradeRequest& request) {
  std::vector<std::string> scenes, clips;
  std::vector<double> sceneScales, clipScales;
  std::vector<UpAxis> sceneUps, clipUps;
  settle.into(scenes, parseFiles("--scenes", texts.scenes));
  settle.into(clips, parseFiles("--clips", texts.clips));
  settle.into(sceneScales, parseScales("--scene-scales", texts.sceneScales, scenes.size()));
  settle.into(sceneUps, parseUpAxes("--scene-ups", texts.sceneUps, scenes.size()));
  settle.into(clipScales, parseScales("--clip-scales", texts.scales, clips.size()));
  settle.into(clipUps, parseUpAxes("--clip-ups", texts.clipUps, clips.size()));
  if (settle.error()) return;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (std::size_t clip = 0; clip < clips.size(); ++clip) {
      BenchFiles files;
      files.scenePath = scenes[scene];
      files.sceneScale = sceneScales[scene];
      files.sceneUp = sceneUps[scene];
      files.motionPath = clips[clip];
      files.motionScale = clipScales[clip];
      files.motionUp = clipUps[clip];
      request.worlds.push_back(std::move(files));
    }
  }
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

Result<TradeRequest> settledTrade(TradeTexts texts) {
  constexpr int kMaxSeed = 1'000'000'000, kMostPlaces = 1000, kMostJudged = 100'000;
  constexpr std::size_t kWorkloadSteps = 60;
  constexpr int kWorkloadPlaces = 200;
  constexpr double kBaseTolerance = 1e-3, kBaseRateHz = 5.0;
  fillIn(texts);
  TradeRequest request;
  Settling settle;
  settleWorlds(texts, settle, request);
  settle.into(request.tolerances, parseTolerances("--tolerance", texts.tolerances));
  settle.require(checkTolerances(request.tolerances));
  settle.into(request.ratesHz, parsePositives("--rate", texts.rates));
  settle.into(request.seconds, parsePositive("--seconds", texts.seconds));
  settle.into(request.places, parseCount("--places", texts.places, kMostPlaces));
  settle.into(request.passes, parseCount("--passes", texts.passes, kMaxBenchRepeats));
  settle.into(request.judged, parseCount("--judged", texts.judged, kMostJudged));
  settle.into(request.workload.floorY, parseNumber("--floor", texts.floor));
  settle.into(request.workload.liftM, parseNumber("--lift", texts.lift));
  int seed = 1, surfaceTriangles = 0;
  settle.into(seed, parseCount("--seed", texts.seed, kMaxSeed));
  settle.into(surfaceTriangles,
              parseCount("--surface-triangles", texts.surfaceTriangles, kMaxBenchTriangles));
  if (settle.error()) return *settle.error();
  request.surfaceTriangles = static_cast<std::size_t>(surfaceTriangles);
  request.workload.seed = static_cast<std::uint64_t>(seed);
  request.workload.steps = kWorkloadSteps;
  request.workload.mostPlacements = kWorkloadPlaces;
  request.baseTolerance = nearestOf(request.tolerances, kBaseTolerance);
  request.baseRateHz = nearestOf(request.ratesHz, kBaseRateHz);
  request.command = ownCommandLine();
  return request;
}

Result<Done> writeText(const std::string& path, const std::string& text) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  const auto written = file.commit();
  return written.ok() ? written : inFile(written.error(), path);
}

Result<Done> writeAll(const TradeTexts& texts, const MeasuredTrade& bench) {
  const BenchTable raw = tradeTable(bench.rows, "rows", "Everything that was measured");
  BenchReport whole = bench.report;
  whole.tables.push_back(raw);
  Settling settle;
  settle.require(writeReport(whole, texts.json, raw, texts.csv));
  if (!texts.html.empty()) settle.require(writeText(texts.html, tradePage(bench)));
  if (!texts.markdown.empty()) {
    settle.require(writeText(texts.markdown, reportMarkdown(bench.report)));
  }
  if (settle.error()) return *settle.error();
  return Done{};
}

Result<Done> checkOutputs(const TradeTexts& texts, const TradeRequest& request) {
  std::vector<std::string> inputs;
  for (const BenchFiles& files : request.worlds) {
    inputs.push_back(files.scenePath);
    inputs.push_back(files.motionPath);
  }
  for (const std::string& output : {texts.json, texts.csv, texts.html, texts.markdown}) {
    FORETOUCH_CHECK(checkIsNoInput(output, inputs));
  }
  return Done{};
}

ExitCode run(const TradeTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledTrade(texts));
  FORETOUCH_CHECK_OR(failed, checkOutputs(texts, request));
  if (texts.processor != "any") {
    const auto processor = parseNumber("--processor", texts.processor);
    if (!processor.ok() || !pinToProcessor(static_cast<int>(processor.value()))) {
      return failed(Error::in(
          "--processor", ErrorCode::OutOfRange,
          "expected a processor that this process may use, found " + inQuotes(texts.processor)));
    }
  }
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrade(request));
  FORETOUCH_CHECK_OR(failed, writeAll(texts, bench));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

constexpr char kFooter[] =
    R"(Every clip in every scene, at every rate that it has, at every tolerance, by every strategy.
Examples:
  foretouch-bench trade --quick --html trade.html
  foretouch-bench trade --clips walk.bvh,kick.bvh --clip-scales 0.01 --scenes room.obj,kitchen.ply --scene-ups y,z \
      --json trade.json --csv trade.csv --html trade.html --markdown trade.md)";

}  // namespace

void addBenchTradeCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<TradeTexts>();
  CLI::App* const command = bench.add_subcommand(
      "trade", "What speed costs in accuracy: strategies, tolerances and rates against the truth");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scenes", texts->scenes, "FILE,...", "Scenes; the bundled room if not given");
  option("--clips", texts->clips, "FILE,...", "Clips; the bundled one if not given");
  option("--scene-scales", texts->sceneScales, "S,...", "Metres per unit, one for all or one each");
  option("--clip-scales,--scales", texts->scales, "S,...", "Of the clips, one for all or one each");
  option("--scene-ups", texts->sceneUps, "y|z,...", "Up axes of scenes, one for all or one each");
  option("--clip-ups,--ups", texts->clipUps, "y|z,...",
         "Up axes of clips, one for all or one each");
  option("--tolerance", texts->tolerances, "M,...", "Tolerances (m)");
  option("--rate", texts->rates, "HZ,...", "Poses a second");
  option("--seconds", texts->seconds, "S", "Of the clip at each place");
  option("--places", texts->places, "N", "Places with contacts in each scene");
  option("--passes", texts->passes, "N", "Of every strategy; a step's least time counts");
  option("--judged", texts->judged, "N",
         "Links per scene and clip that an independent judge checks");
  option("--floor", texts->floor, "Y", "Height (m) of the scene's floor");
  option("--lift", texts->lift, "M", "The clip's lowest point stays so far (m) above the floor");
  option("--seed", texts->seed, "N", "Of the places");
  option("--processor", texts->processor, "N", "Keep to this processor");
  option("--surface-triangles", texts->surfaceTriangles, "N",
         "Of an avatar without meshes, at exact fidelity: the skins of its LSS");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write one line per setting to a file");
  option("--html", texts->html, "FILE", "Also write a page with plots, which needs nothing else");
  option("--markdown", texts->markdown, "FILE", "Also write the tables as Markdown");
  command->add_flag("--quick", texts->quick, "Few values and steps: a trial of seconds");
  command->footer(kFooter);
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
