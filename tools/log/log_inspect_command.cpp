#include "tools/log/log_inspect_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/log/log_inspection.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedLogs {
  std::vector<std::string> logs;
  bool json = false;
};

ExitCode info(const AskedLogs& asked) {
  ExitCode exit = ExitCode::Done;
  for (const std::string& path : asked.logs) {
    const auto inspection = inspectLog(path);
    if (!inspection.ok()) {
      if (asked.json) printOut(jsonLine(path, inspection.error()));
      exit = failed(inFile(inspection.error(), path));
      continue;
    }
    printOut(asked.json ? jsonLine(inspection.value()) : describe(inspection.value()));
  }
  return exit;
}

void printFindings(const LogInspection& inspection) {
  for (const LogFinding& finding : inspection.findings) {
    printError(inspection.path + ": " + describe(finding));
  }
  if (inspection.unlistedFindings > 0) {
    printError(fmt::format("{}: and {} more", inspection.path, inspection.unlistedFindings));
  }
}

ExitCode checkOne(const std::string& path, bool asJson) {
  const auto read = inspectLog(path);
  if (!read.ok()) {
    if (asJson) printOut(jsonLine(path, read.error()));
    return failed(inFile(read.error(), path));
  }
  const LogInspection& inspection = read.value();
  if (asJson) {
    printOut(jsonLine(inspection));
  } else {
    printFindings(inspection);
    printOut(fmt::format("{}: {}, {} events{}, {}\n", path,
                         inspection.isSound() ? "sound" : "damaged", inspection.counts.events,
                         inspection.counts.hasCheckSums ? "" : ", none of them checked",
                         formatOf(inspection.counts)));
  }
  return inspection.isSound() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

ExitCode check(const AskedLogs& asked) {
  ExitCode worst = ExitCode::Done;
  for (const std::string& path : asked.logs) {
    worst = std::max(worst, checkOne(path, asked.json));
  }
  return worst;
}

Command commandOf(const char* name, const char* purpose, const char* example,
                  ExitCode (*run)(const AskedLogs&)) {
  const auto asked = std::make_shared<AskedLogs>();
  Settings settings;
  settings.list("log", "LOG", asked->logs, "LCM event logs")
      .files("lcmlog")
      .required("an event log");
  settings.asJson(asked->json).help = "Print one line of JSON per log (docs/formats.md)";
  Command command{name, purpose, example, std::move(settings)};
  command.run = [asked, run](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace

Command logInfoCommand() {
  return commandOf("info", "What is in a log: channels, rates, times",
                   "Example:\n  foretouch log info today.lcmlog", info);
}

Command logCheckCommand() {
  return commandOf("check",
                   "Read logs to the end; exit code 1 where one is damaged, 2 where one is no log",
                   "Example:\n  foretouch log check *.lcmlog", check);
}

}  // namespace foretouch::tools
