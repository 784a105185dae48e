#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "tools/settings/lists.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/solid.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedSolid {
  SolidBenchRequest request;
  std::string json, csv;
};

ExitCode run(AskedSolid& asked) {
  /// Of the skin, as SolidOptions has them.
  constexpr double kToleranceShare = 0.25;
  SolidBenchRequest& request = asked.request;
  request.trials.options.tolerance = kToleranceShare * request.trials.options.skin;
  if (request.dataFolder.empty()) request.dataFolder = usualData();
  request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto bench, measureSolid(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  if (bench.violations == 0) return ExitCode::Done;
  printError(fmt::format("{} ticks broke the promise", bench.violations));
  return ExitCode::CheckSaysNo;
}

void addTrials(Settings& settings, TrialRequest& trials) {
  constexpr int kMostSeed = 1'000'000'000, kMostTrials = 100'000'000;
  settings.whole("--seed", "N", trials.seed, 1, kMostSeed, "Of the places");
  settings.number("--skin", "M", trials.options.skin, kAboveZero,
                  "Gap that the avatar keeps; the tolerance is a quarter of it");
  settings.whole("--goals", "N", trials.goals, 1, kMostTrials, "Free places among clutter");
  settings.whole("--board-trials", "N", trials.boardTrials, 1, kMostTrials,
                 "Hands led through a board, in all; of other hands 200 per speed and depth");
}

}  // namespace

Command solidBenchCommand() {
  constexpr int kMostPlaces = 1000;
  const auto asked = std::make_shared<AskedSolid>();
  SolidBenchRequest& request = asked->request;
  Settings settings;
  settings.path("--data", "FOLDER", request.dataFolder,
                "With mocap/ and scenes/; $FORETOUCH_DATA, else ../shared/data, if not given");
  addWords(settings, "--scenes", "NAME,...", request.scenes, {},
           "kitchen, office, collision-world, undulating, room; kitchen,office,room if not given");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths; six if not given");
  addWords(settings, "--parts", "NAME,...", request.parts,
           {std::begin(kSolidParts), std::end(kSolidParts)},
           "scenes (clips in furniture), board, clutter, slide, press; all if not given");
  addNumbers(settings, "--rates", "HZ,...", request.ratesHz, kAboveZero,
             "Tracked poses per second");
  settings.whole("--places", "N", request.places, 1, kMostPlaces, "Busy places per clip and scene");
  settings.number("--seconds", "S", request.seconds, kAboveZero, "Of the clip at each place");
  addTrials(settings, request.trials);
  addFigures(settings, asked->json, asked->csv, "Also write the first table to a file");
  Command command{
      "solid", "How a solid avatar feels and what it costs; exit code 1 where it breaks a promise",
      "Example:\n  foretouch-bench solid --scenes office --rates 90,30,10", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
