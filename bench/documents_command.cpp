#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/commands.h"
#include "bench/documents.h"

namespace foretouch::tools {
namespace {

/// A callgrind file of this program has a few megabytes.
constexpr std::size_t kMaxCallgrindBytes = std::size_t{1} << 30;

Result<Done> writeText(const std::string& path, const std::string& text) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return file.commit();
}

ExitCode runReport(const std::vector<std::string>& files, const std::string& output) {
  std::vector<BenchReport> reports;
  for (const std::string& path : files) {
    FORETOUCH_TRY_OR(failed, auto report, readReport(path));
    reports.push_back(std::move(report));
  }
  const std::string text = performanceDocument(reports);
  if (output.empty()) {
    printOut(text);
    return ExitCode::Done;
  }
  const auto written = writeText(output, text);
  return written.ok() ? ExitCode::Done : failed(inFile(written.error(), output));
}

struct AskedInstructions {
  std::string callgrind, latency, recorded;
  bool record = false;
};

Result<BenchReport> countedNow(const AskedInstructions& asked) {
  FORETOUCH_TRY(const auto profile, readWholeFile(asked.callgrind, kMaxCallgrindBytes));
  FORETOUCH_TRY(const auto instructions, callgrindInstructions(profile, asked.callgrind));
  FORETOUCH_TRY(const auto latency, readReport(asked.latency));
  auto now = instructionReport(latency, instructions);
  if (!now.ok()) return inFile(now.error(), asked.latency);
  return now;
}

ExitCode runInstructions(const AskedInstructions& asked) {
  FORETOUCH_TRY_OR(failed, const auto now, countedNow(asked));
  if (asked.record) {
    FORETOUCH_CHECK_OR(failed, writeText(asked.recorded, reportJson(now)));
    printOut(reportText(now));
    return ExitCode::Done;
  }
  FORETOUCH_TRY_OR(failed, const auto recorded, readReport(asked.recorded));
  printOut(tableText(movedTable(recorded, now)));
  return ExitCode::Done;
}

}  // namespace

Command performanceCommand() {
  struct AskedReport {
    std::vector<std::string> files;
    std::string output;
  };
  const auto asked = std::make_shared<AskedReport>();
  Settings settings;
  settings.list("files", "FILE...", asked->files, "Files that --json wrote")
      .required("files that --json wrote");
  settings.path("--output", "FILE", asked->output, "Where to; standard output if not given");
  Command command{"report", "Make docs/performance.md of the files of --json", "",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return runReport(asked->files, asked->output); };
  return command;
}

Command instructionsCommand() {
  const auto asked = std::make_shared<AskedInstructions>();
  Settings settings;
  settings.path("--callgrind", "FILE", asked->callgrind, "callgrind.out of the run").required();
  settings.path("--latency", "FILE", asked->latency, "What --json wrote in the run").required();
  settings.path("--recorded", "FILE", asked->recorded, "The record").required();
  settings.flag("--record", asked->record, "Write the record instead of comparing");
  Command command{"instructions",
                  "Compare callgrind's count of a latency run with the recorded one",
                  "`./run instructions` does the whole.", std::move(settings)};
  command.run = [asked](const Settings&) { return runInstructions(*asked); };
  return command;
}

}  // namespace foretouch::tools
