#include "bench/extremes_command.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/extremes.h"
#include "bench/extremes/case_json.h"
#include "bench/machine.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

constexpr int kMostCases = 10'000'000, kMostSeed = 2'000'000'000, kMostCoincident = 10'000'000;

struct ExtremesTexts {
  std::string cases = "100", seed = "1", only, coincident = "100000", json, csv, dump;
  bool lists = false;
};

Result<ExtremesRequest> settledExtremes(const ExtremesTexts& texts) {
  ExtremesRequest request;
  Settling settle;
  int cases = 0, seed = 0, coincident = 0;
  settle.into(cases, parseCount("--cases", texts.cases, kMostCases));
  settle.into(seed, parseCount("--seed", texts.seed, kMostSeed));
  settle.into(coincident, parseCount("--coincident", texts.coincident, kMostCoincident));
  if (settle.error()) return *settle.error();
  request.cases = cases;
  request.seed = static_cast<std::uint64_t>(seed);
  request.sizes.coincident = static_cast<std::size_t>(coincident);
  if (!texts.only.empty()) request.only = splitAtCommas(texts.only);
  request.command = ownCommandLine();
  return request;
}

Result<Done> writeDump(const std::string& path, const std::vector<extremes::ExtremeCase>& cases) {
  if (path.empty()) return Done{};
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(extremes::casesJson(cases));
  return file.commit();
}

ExitCode run(const ExtremesTexts& texts) {
  if (texts.lists) {
    printOut(familiesText());
    return ExitCode::Done;
  }
  FORETOUCH_TRY_OR(failed, const auto request, settledExtremes(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureExtremes(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  FORETOUCH_CHECK_OR(failed, writeDump(texts.dump, bench.worst));
  printOut(reportText(report));
  if (bench.isSound) return ExitCode::Done;
  printError("answers are unsound or faulty: see the notes below the table");
  return ExitCode::CheckSaysNo;
}

constexpr char kFooter[] =
    R"(Case i of a family has the seed --seed + i: --only FAMILY --seed S --cases 1 replays it.
Examples:
  foretouch-bench extremes --cases 20
  foretouch-bench extremes --only far,grazing --cases 1000 --json extremes.json
  foretouch-bench extremes --only denormals --seed 42 --cases 1 --dump case.json)";

}  // namespace

void addBenchExtremesCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<ExtremesTexts>();
  CLI::App* const command = bench.add_subcommand(
      "extremes",
      "Inputs at the edge of what is legal, against an oracle of fifty digits; exit code 1 on any "
      "unsound or faulty answer");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--cases", texts->cases, "N", "Of each family; costly families take a share of it");
  option("--seed", texts->seed, "S", "Of each family's first case");
  option("--only", texts->only, "FAMILY,...", "These families (--list)");
  option("--coincident", texts->coincident, "N", "Triangles in one place");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the table to a file");
  option("--dump", texts->dump, "FILE", "Also write the worst and the faulty inputs to a file");
  command->add_flag("--list", texts->lists, "Show the families");
  command->footer(kFooter);
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
