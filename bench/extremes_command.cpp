#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/commands.h"
#include "bench/extremes.h"
#include "bench/extremes/case_json.h"
#include "tools/settings/lists.h"
#include "bench/machine.h"
#include "bench/options.h"

namespace foretouch::tools {
namespace {

constexpr int kMostCases = 10'000'000, kMostSeed = 2'000'000'000, kMostCoincident = 10'000'000;

struct AskedExtremes {
  ExtremesRequest request;
  std::string json, csv, dump;
  bool lists = false;
};

Result<Done> writeDump(const std::string& path, const std::vector<extremes::ExtremeCase>& cases) {
  if (path.empty()) return Done{};
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(extremes::casesJson(cases));
  return file.commit();
}

ExitCode run(AskedExtremes& asked) {
  if (asked.lists) {
    printOut(familiesText());
    return ExitCode::Done;
  }
  asked.request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto bench, measureExtremes(asked.request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  FORETOUCH_CHECK_OR(failed, writeDump(asked.dump, bench.worst));
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

Command extremesCommand() {
  const auto asked = std::make_shared<AskedExtremes>();
  ExtremesRequest& request = asked->request;
  Settings settings;
  settings.whole("--cases", "N", request.cases, 1, kMostCases,
                 "Of each family; costly families take a share of it");
  settings.whole("--seed", "S", request.seed, 1, kMostSeed, "Of each family's first case");
  addWords(settings, "--only", "FAMILY,...", request.only, {}, "These families (--list)");
  settings.whole("--coincident", "N", request.sizes.coincident, 1, kMostCoincident,
                 "Triangles in one place");
  addFigures(settings, asked->json, asked->csv, "Also write the table to a file");
  settings.output("--dump", "FILE", asked->dump,
                  "Also write the worst and the faulty inputs to a file");
  settings.flag("--list", asked->lists, "Show the families");
  Command command{"extremes",
                  "Inputs at the edge of what is legal, against an oracle of fifty digits; exit "
                  "code 1 on any unsound or faulty answer",
                  kFooter, std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
