#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/ask.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "tools/settings/lists.h"

namespace foretouch::tools {
namespace {

struct AskedBench {
  AskBenchRequest request;
  std::string json, csv;
};

ExitCode run(AskedBench& asked) {
  AskBenchRequest& request = asked.request;
  if (request.dataFolder.empty()) request.dataFolder = usualData();
  request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto bench, measureAsk(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  if (bench.violations == 0) return ExitCode::Done;
  printError(fmt::format("{} answers are not the judge's", bench.violations));
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command askBenchCommand() {
  constexpr int kMostAvatars = 10'000, kMost = 10'000'000, kMostSeed = 1'000'000'000;
  const auto asked = std::make_shared<AskedBench>();
  AskBenchRequest& request = asked->request;
  Settings settings;
  settings.path("--data", "FOLDER", request.dataFolder,
                "With mocap/; $FORETOUCH_DATA, else ../shared/data, if not given");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths; six if not given, or the bundled dancer where these are absent");
  addWords(
      settings, "--parts", "NAME,...", request.parts, {std::begin(kAskParts), std::end(kAskParts)},
      "crowd, players (of a server), scene (beside Embree), shots (at who is seen late); all if "
      "not given");
  addCounts(settings, "--avatars", "N,...", request.avatars, kMostAvatars, "Of each crowd");
  settings.whole("--questions", "N", request.questions, 1, kMost, "Of each kind");
  settings.whole("--shots", "N", request.shots, 1, kMost, "Per row");
  settings.whole("--triangles", "N", request.triangles, 1, kMost, "Of the room of rays");
  settings.whole("--seed", "N", request.seed, 1, kMostSeed, "Of the questions");
  addFigures(settings, asked->json, asked->csv, "Also write the first table to a file");
  Command command{
      "ask", "What questions to a world cost, and what other ways to look at the past miss",
      "Example:\n  foretouch-bench ask --parts shots --shots 1000", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
