#include "tools/log/log_inspect_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/log/log_inspection.h"

namespace foretouch::tools {
namespace {

struct InspectTexts {
  std::vector<std::string> logs;
  bool json = false;
};

ExitCode info(const InspectTexts& texts) {
  ExitCode exit = ExitCode::Done;
  for (const std::string& path : texts.logs) {
    const auto inspection = inspectLog(path);
    if (!inspection.ok()) {
      if (texts.json) printOut(jsonLine(path, inspection.error()));
      exit = failed(inFile(inspection.error(), path));
      continue;
    }
    printOut(texts.json ? jsonLine(inspection.value()) : describe(inspection.value()));
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

ExitCode checkOne(const std::string& path, bool json) {
  const auto read = inspectLog(path);
  if (!read.ok()) {
    if (json) printOut(jsonLine(path, read.error()));
    return failed(inFile(read.error(), path));
  }
  const LogInspection& inspection = read.value();
  if (json) {
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

ExitCode check(const InspectTexts& texts) {
  ExitCode worst = ExitCode::Done;
  for (const std::string& path : texts.logs) {
    worst = std::max(worst, checkOne(path, texts.json));
  }
  return worst;
}

std::shared_ptr<InspectTexts> addOptions(CLI::App& command) {
  auto texts = std::make_shared<InspectTexts>();
  command.add_option("log", texts->logs, "LCM event logs")->type_name("LOG")->required();
  command.add_flag("--json", texts->json, "One line of JSON a log, on stdout");
  return texts;
}

}  // namespace

void addLogInfoCommand(CLI::App& log, ExitCode& exit) {
  CLI::App* const command = log.add_subcommand("info", "What is in a log: channels, rates, times");
  const auto texts = addOptions(*command);
  command->footer("Example:\n  foretouch log info today.lcmlog");
  command->callback([texts, &exit] { exit = info(*texts); });
}

void addLogCheckCommand(CLI::App& log, ExitCode& exit) {
  CLI::App* const command = log.add_subcommand(
      "check", "Read logs to the end; exit code 1 where one is damaged, 2 where one is no log");
  const auto texts = addOptions(*command);
  command->footer("Example:\n  foretouch log check *.lcmlog");
  command->callback([texts, &exit] { exit = check(*texts); });
}

}  // namespace foretouch::tools
