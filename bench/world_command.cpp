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
#include "bench/world.h"

namespace foretouch::tools {
namespace {

struct AskedWorld {
  WorldBenchRequest request;
  std::string json, csv;
};

ExitCode run(AskedWorld& asked) {
  WorldBenchRequest& request = asked.request;
  if (request.dataFolder.empty()) request.dataFolder = usualData();
  request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto bench, measureWorld(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  if (bench.violations == 0) return ExitCode::Done;
  printError(fmt::format("{} answers broke the promise", bench.violations));
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command worldBenchCommand() {
  constexpr int kMostAvatars = 10'000, kMostPairs = 10'000'000, kMostSeed = 1'000'000'000;
  const auto asked = std::make_shared<AskedWorld>();
  WorldBenchRequest& request = asked->request;
  Settings settings;
  settings.path("--data", "FOLDER", request.dataFolder,
                "With mocap/; $FORETOUCH_DATA, else ../shared/data, if not given");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths; six if not given, or the bundled dancer where these are absent");
  addWords(settings, "--parts", "NAME,...", request.parts,
           {std::begin(kWorldParts), std::end(kWorldParts)},
           "crowd, self, clocks, platform, prop, exact, pairs (beside FCL and Bullet), ticking, "
           "events, following; all if not given");
  addCounts(settings, "--avatars", "N,...", request.avatars, kMostAvatars, "Of each crowd");
  settings.whole("--pairs", "N", request.pairs, 1, kMostPairs, "Of capsules that both move");
  settings.whole("--windows", "N", request.tickingWindows, 1, kMostPairs,
                 "Of 0.2 s, of two people beside a game that ticks");
  settings.whole("--seed", "N", request.seed, 1, kMostSeed, "Of the pairs");
  addFigures(settings, asked->json, asked->csv, "Also write the first table to a file");
  Command command{
      "world", "What a moving world costs, beside others; exit code 1 where it breaks a promise",
      "Example:\n  foretouch-bench world --parts crowd --avatars 1000", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
