#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bench/cage.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"

namespace foretouch::tools {
namespace {

struct AskedCage {
  CageRequest request;
  std::string json, csv;
};

ExitCode run(AskedCage& asked) {
  asked.request.command = ownCommandLine();
  FORETOUCH_TRY_OR(failed, const auto report, measureCage(asked.request));
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  return ExitCode::Done;
}

}  // namespace

Command cageCommand() {
  const auto asked = std::make_shared<AskedCage>();
  Settings settings;
  settings.whole("--triangles", "N", asked->request.triangles, 1, kMaxBenchTriangles,
                 "Of the file that is imported");
  settings.whole("--repeat", "N", asked->request.repeats, 1, kMaxBenchRepeats,
                 "Pairs of imports, without and with the cage");
  addFigures(settings, asked->json, asked->csv, "Also write the first table to a file");
  Command command{"cage", "What the importer's cage costs an import, and what it bounds",
                  "Example:\n  foretouch-bench cage --triangles 100000 --json cage.json",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
