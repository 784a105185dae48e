#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/crowds.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/private_network.h"
#include "bench/trust.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedTrust {
  TrustRequest request;
  std::string json, csv;
};

ExitCode run(AskedTrust& asked) {
  asked.request.command = ownCommandLine();
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrust(asked.request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  if (bench.lost == 0) return ExitCode::Done;
  printError("true poses were lost beside a flood: see the first table");
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command trustCommand() {
  const auto asked = std::make_shared<AskedTrust>();
  Settings settings;
  settings.number("--seconds", "S", asked->request.seconds, kAboveZero, "Of each row");
  addDancerPlace(settings, asked->request.place);
  settings.path("--hardened", "FOLDER", asked->request.hardened,
                "A hardened build, build/packages say: also what that costs queries and services");
  addFigures(settings, asked->json, asked->csv, "Also write the first table to a file");
  Command command{"trust",
                  "Floods, slow clients and refused poses beside a true sender; exit code 1 where "
                  "a true pose is lost",
                  "Examples:\n  foretouch-bench trust --seconds 5 --json trust.json\n"
                  "  foretouch-bench trust --hardened build/packages",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
