#include "bench/cage_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/cage.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct CageTexts {
  std::string triangles = "100000", repeat = "15", json, csv;
};

ExitCode runCage(const CageTexts& texts) {
  CageRequest request;
  Settling settle;
  settle.into(request.triangles, parseCount("--triangles", texts.triangles, kMaxBenchTriangles));
  settle.into(request.repeats, parseCount("--repeat", texts.repeat, kMaxBenchRepeats));
  if (settle.error()) return failed(*settle.error());
  request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto report, measureCage(request));
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  return ExitCode::Done;
}

}  // namespace

void addBenchCageCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<CageTexts>();
  CLI::App* const command =
      bench.add_subcommand("cage", "What the importer's cage costs an import, and what it bounds");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--triangles", texts->triangles, "N", "Of the file that is imported");
  option("--repeat", texts->repeat, "N", "Pairs of imports, without and with the cage");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the first table to a file");
  command->footer("Example:\n  foretouch-bench cage --triangles 100000 --json cage.json");
  command->callback([texts, &exit] { exit = runCage(*texts); });
}

}  // namespace foretouch::tools
