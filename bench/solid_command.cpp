#include "bench/solid_command.h"

#include <cstdlib>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/solid.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct SolidTexts {
  std::string data, scenes, clips, rates = "90", places = "2", seconds = "4", seed = "1",
                                   skin = "0.002", json, csv;
};

std::string usualData() {
  const char* fromEnvironment = std::getenv("FORETOUCH_DATA");
  return fromEnvironment != nullptr ? fromEnvironment : "../shared/data";
}

Result<SolidBenchRequest> settledSolid(const SolidTexts& texts) {
  constexpr int kMostPlaces = 1000, kMostSeed = 1'000'000'000;
  /// Of the skin, as SolidOptions has them.
  constexpr double kToleranceShare = 0.25;
  SolidBenchRequest request;
  Settling settle;
  int seed = 1;
  settle.into(request.ratesHz, parsePositives("--rates", texts.rates));
  settle.into(request.places, parseCount("--places", texts.places, kMostPlaces));
  settle.into(request.seconds, parsePositive("--seconds", texts.seconds));
  settle.into(seed, parseCount("--seed", texts.seed, kMostSeed));
  settle.into(request.options.skin, parsePositive("--skin", texts.skin));
  if (settle.error()) return *settle.error();
  request.seed = static_cast<std::uint64_t>(seed);
  request.options.tolerance = kToleranceShare * request.options.skin;
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
  option("--rates", texts->rates, "HZ,...", "Tracked poses per second");
  option("--places", texts->places, "N", "Busy places per clip and scene");
  option("--seconds", texts->seconds, "S", "Of the clip at each place");
  option("--seed", texts->seed, "N", "Of the places");
  option("--skin", texts->skin, "M", "Gap that the avatar keeps; the tolerance is a quarter of it");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the first table to a file");
  command->footer("Example:\n  foretouch-bench solid --scenes office --rates 90,30,10");
  command->callback([texts, &exit] { exit = runSolid(*texts); });
}

}  // namespace foretouch::tools
