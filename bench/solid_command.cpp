#include "bench/solid_command.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/solid.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct SolidTexts {
  std::string data, scenes, clips, parts, rates = "90", places = "2", seconds = "4", seed = "1",
                                          skin = "0.002", goals = "1000", board = "10000", json,
                                          csv;
};

std::string usualData() {
  const char* fromEnvironment = std::getenv("FORETOUCH_DATA");
  return fromEnvironment != nullptr ? fromEnvironment : "../shared/data";
}

Result<std::vector<std::string>> partsNamed(const std::string& text) {
  std::vector<std::string> parts;
  if (!text.empty()) parts = splitAtCommas(text);
  for (const std::string& part : parts) {
    if (std::find(std::begin(kSolidParts), std::end(kSolidParts), part) == std::end(kSolidParts)) {
      return Error::in("--parts", ErrorCode::UnknownName,
                       "expected scenes, board, clutter, slide or press, found " + inQuotes(part));
    }
  }
  return parts;
}

Result<SolidBenchRequest> settledSolid(const SolidTexts& texts) {
  constexpr int kMostPlaces = 1000, kMostSeed = 1'000'000'000, kMostTrials = 100'000'000;
  /// Of the skin, as SolidOptions has them.
  constexpr double kToleranceShare = 0.25;
  SolidBenchRequest request;
  Settling settle;
  int seed = 1, board = 1;
  settle.into(request.parts, partsNamed(texts.parts));
  settle.into(request.ratesHz, parsePositives("--rates", texts.rates));
  settle.into(request.places, parseCount("--places", texts.places, kMostPlaces));
  settle.into(request.seconds, parsePositive("--seconds", texts.seconds));
  settle.into(seed, parseCount("--seed", texts.seed, kMostSeed));
  settle.into(board, parseCount("--board-trials", texts.board, kMostTrials));
  settle.into(request.trials.goals, parseCount("--goals", texts.goals, kMostTrials));
  settle.into(request.trials.options.skin, parsePositive("--skin", texts.skin));
  if (settle.error()) return *settle.error();
  request.trials.seed = static_cast<std::uint64_t>(seed);
  request.trials.boardTrials = static_cast<std::uint64_t>(board);
  request.trials.options.tolerance = kToleranceShare * request.trials.options.skin;
  request.dataFolder = texts.data.empty() ? usualData() : texts.data;
  if (!texts.scenes.empty()) request.scenes = splitAtCommas(texts.scenes);
  if (!texts.clips.empty()) request.clips = splitAtCommas(texts.clips);
  request.command = ownCommandLine();
  return request;
}

ExitCode runSolid(const SolidTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledSolid(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureSolid(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  if (bench.violations == 0) return ExitCode::Done;
  printError(fmt::format("{} ticks broke the promise", bench.violations));
  return ExitCode::CheckSaysNo;
}

}  // namespace

void addBenchSolidCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<SolidTexts>();
  CLI::App* const command = bench.add_subcommand(
      "solid", "How a solid avatar feels and what it costs; exit code 1 where it breaks a promise");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--data", texts->data, "FOLDER",
         "With mocap/ and scenes/; $FORETOUCH_DATA, else ../shared/data, if not given");
  option("--scenes", texts->scenes, "NAME,...",
         "kitchen, office, collision-world, undulating, room; kitchen,office,room if not given");
  option("--clips", texts->clips, "NAME,...", "Of mocap/, or paths; six if not given");
  option("--parts", texts->parts, "NAME,...",
         "scenes (clips in furniture), board, clutter, slide, press; all if not given");
  option("--rates", texts->rates, "HZ,...", "Tracked poses per second");
  option("--places", texts->places, "N", "Busy places per clip and scene");
  option("--seconds", texts->seconds, "S", "Of the clip at each place");
  option("--seed", texts->seed, "N", "Of the places");
  option("--skin", texts->skin, "M", "Gap that the avatar keeps; the tolerance is a quarter of it");
  option("--goals", texts->goals, "N", "Free places among clutter");
  option("--board-trials", texts->board, "N",
         "Hands led through a board, in all; of other hands 200 per speed and depth");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the first table to a file");
  command->footer("Example:\n  foretouch-bench solid --scenes office --rates 90,30,10");
  command->callback([texts, &exit] { exit = runSolid(*texts); });
}

}  // namespace foretouch::tools
