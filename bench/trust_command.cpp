#include "bench/trust_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/private_network.h"
#include "bench/trust.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct TrustTexts {
  std::string seconds = "5", place = "0,0,0,0", hardened, json, csv;
};

ExitCode runTrust(const TrustTexts& texts) {
  TrustRequest request;
  Settling settle;
  settle.into(request.seconds, parsePositive("--seconds", texts.seconds));
  settle.into(request.place, parsePlacement("--place", texts.place));
  if (settle.error()) return failed(*settle.error());
  request.hardened = texts.hardened;
  request.command = ownCommandLine();
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrust(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  if (bench.lost == 0) return ExitCode::Done;
  printError("true poses were lost beside a flood: see the first table");
  return ExitCode::CheckSaysNo;
}

}  // namespace

void addBenchTrustCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<TrustTexts>();
  CLI::App* const command = bench.add_subcommand(
      "trust",
      "Floods, slow clients and refused poses beside a true sender; exit code 1 where a "
      "true pose is lost");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--seconds", texts->seconds, "S", "Of each row");
  option("--place", texts->place, "X,Y,Z[,YAW]", "Where the bundled dancer stands in the room");
  option("--hardened", texts->hardened, "FOLDER",
         "A hardened build, build/packages say: also what that costs queries and services");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the first table to a file");
  command->footer(
      "Examples:\n  foretouch-bench trust --seconds 5 --json trust.json\n"
      "  foretouch-bench trust --hardened build/packages");
  command->callback([texts, &exit] { exit = runTrust(*texts); });
}

}  // namespace foretouch::tools
