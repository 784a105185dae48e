#include "bench/documents_command.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "assets/text_file.h"
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

struct InstructionTexts {
  std::string callgrind, latency, recorded;
  bool record = false;
};

Result<BenchReport> countedNow(const InstructionTexts& texts) {
  FORETOUCH_TRY(const auto profile, readWholeFile(texts.callgrind, kMaxCallgrindBytes));
  FORETOUCH_TRY(const auto instructions, callgrindInstructions(profile, texts.callgrind));
  FORETOUCH_TRY(const auto latency, readReport(texts.latency));
  auto now = instructionReport(latency, instructions);
  if (!now.ok()) return inFile(now.error(), texts.latency);
  return now;
}

ExitCode runInstructions(const InstructionTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto now, countedNow(texts));
  if (texts.record) {
    FORETOUCH_CHECK_OR(failed, writeText(texts.recorded, reportJson(now)));
    printOut(reportText(now));
    return ExitCode::Done;
  }
  FORETOUCH_TRY_OR(failed, const auto recorded, readReport(texts.recorded));
  printOut(tableText(movedTable(recorded, now)));
  return ExitCode::Done;
}

}  // namespace

void addBenchDocumentCommands(CLI::App& bench, ExitCode& exit) {
  struct ReportTexts {
    std::vector<std::string> files;
    std::string output;
  };
  const auto report = std::make_shared<ReportTexts>();
  CLI::App* const reportCommand =
      bench.add_subcommand("report", "Make docs/performance.md of the files of --json");
  reportCommand->add_option("files", report->files, "Files that --json wrote")
      ->type_name("FILE...")
      ->required();
  reportCommand->add_option("--output", report->output, "Where to; standard output if not given")
      ->type_name("FILE");
  reportCommand->callback([report, &exit] { exit = runReport(report->files, report->output); });

  const auto texts = std::make_shared<InstructionTexts>();
  CLI::App* const instructions = bench.add_subcommand(
      "instructions", "Compare callgrind's count of a latency run with the recorded one");
  instructions->add_option("--callgrind", texts->callgrind, "callgrind.out of the run")
      ->type_name("FILE")
      ->required();
  instructions->add_option("--latency", texts->latency, "What --json wrote in the run")
      ->type_name("FILE")
      ->required();
  instructions->add_option("--recorded", texts->recorded, "The record")
      ->type_name("FILE")
      ->required();
  instructions->add_flag("--record", texts->record, "Write the record instead of comparing");
  instructions->footer("`./run instructions` does the whole.");
  instructions->callback([texts, &exit] { exit = runInstructions(*texts); });
}

}  // namespace foretouch::tools
