#include "bench/world_command.h"

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
#include "bench/world.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct WorldTexts {
  std::string data, clips, parts, avatars = "2,10,30,100,300,1000,3000", pairs = "2000",
                                  windows = "100", seed = "1", json, csv;
};

Result<std::vector<std::string>> worldPartsNamed(const std::string& text) {
  std::vector<std::string> parts;
  if (!text.empty()) parts = splitAtCommas(text);
  for (const std::string& part : parts) {
    if (std::find(std::begin(kWorldParts), std::end(kWorldParts), part) == std::end(kWorldParts)) {
      return Error::in(
          "--parts", ErrorCode::UnknownName,
          "expected crowd, self, clocks, platform, prop, exact, pairs, ticking, events or "
          "following, found " +
              inQuotes(part));
    }
  }
  return parts;
}

Result<WorldBenchRequest> settledWorld(const WorldTexts& texts) {
  constexpr int kMostAvatars = 10'000, kMostPairs = 10'000'000, kMostSeed = 1'000'000'000;
  WorldBenchRequest request;
  Settling settle;
  int seed = 1;
  settle.into(request.parts, worldPartsNamed(texts.parts));
  settle.into(request.avatars, parseCounts("--avatars", texts.avatars, kMostAvatars));
  settle.into(request.pairs, parseCount("--pairs", texts.pairs, kMostPairs));
  settle.into(request.tickingWindows, parseCount("--windows", texts.windows, kMostPairs));
  settle.into(seed, parseCount("--seed", texts.seed, kMostSeed));
  if (settle.error()) return *settle.error();
  request.seed = static_cast<std::uint64_t>(seed);
  const char* const fromEnvironment = std::getenv("FORETOUCH_DATA");
  request.dataFolder = fromEnvironment != nullptr ? fromEnvironment : "../shared/data";
  if (!texts.data.empty()) request.dataFolder = texts.data;
  if (!texts.clips.empty()) request.clips = splitAtCommas(texts.clips);
  request.command = ownCommandLine();
  return request;
}

ExitCode runWorld(const WorldTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledWorld(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureWorld(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  if (bench.violations == 0) return ExitCode::Done;
  printError(fmt::format("{} answers broke the promise", bench.violations));
  return ExitCode::CheckSaysNo;
}

}  // namespace

void addBenchWorldCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<WorldTexts>();
  CLI::App* const command = bench.add_subcommand(
      "world", "What a moving world costs, beside others; exit code 1 where it breaks a promise");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--data", texts->data, "FOLDER",
         "With mocap/; $FORETOUCH_DATA, else ../shared/data, if not given");
  option("--clips", texts->clips, "NAME,...",
         "Of mocap/, or paths; six if not given, or the bundled dancer where these are absent");
  option(
      "--parts", texts->parts, "NAME,...",
      "crowd, self, clocks, platform, prop, exact, pairs (beside FCL and Bullet), ticking, events, "
      "following; all "
      "if not given");
  option("--avatars", texts->avatars, "N,...", "Of each crowd");
  option("--pairs", texts->pairs, "N", "Of capsules that both move");
  option("--windows", texts->windows, "N", "Of 0.2 s, of two people beside a game that ticks");
  option("--seed", texts->seed, "N", "Of the pairs");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the first table to a file");
  command->footer("Example:\n  foretouch-bench world --parts crowd --avatars 1000");
  command->callback([texts, &exit] { exit = runWorld(*texts); });
}

}  // namespace foretouch::tools
