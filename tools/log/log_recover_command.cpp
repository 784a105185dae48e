#include "tools/log/log_recover_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/log/log_inspection.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

struct RecoverTexts {
  std::string log, output;
  bool keepTail = false;
};

/// What can be trusted of the one, into the other.
Result<LogCounts> copyEvents(EventLogReader& reader, EventLogWriter& writer) {
  ProgressBar bar("recover", static_cast<std::int64_t>(reader.size()));
  for (LogEvent event;;) {
    const auto more = reader.next(event);
    if (!more.ok()) return more.error();
    if (!more.value()) break;
    const auto written = writer.write(event.utimeUs, event.channel, event.payload);
    if (!written.ok()) return written.error();
    bar.advanceTo(static_cast<std::int64_t>(reader.position()));
  }
  const auto closed = writer.close();
  if (!closed.ok()) return closed.error();
  return reader.counts();
}

std::string summary(const RecoverTexts& texts, const LogCounts& counts) {
  std::string text =
      fmt::format("{}: {} events written to {}\n", texts.log, counts.events, texts.output);
  const auto add = [&text](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("  {:<25}{}\n", what, count);
  };
  add(counts.uncheckedEvents, "that nothing checked");
  add(counts.badBlocks, "bad blocks");
  add(counts.missingBlocks, "missing blocks");
  add(counts.badEvents, "bad events");
  add(counts.tailEvents, texts.keepTail ? "unchecked tail, kept" : "unchecked tail, left out");
  add(counts.skippedBytes, "bytes lost");
  return text;
}

ExitCode recover(const RecoverTexts& texts) {
  LogReadOptions options;
  options.keepTail = texts.keepTail;
  std::size_t findings = 0;
  options.onFinding = [&](const LogFinding& finding) {
    if (++findings <= kMaxListedFindings) printNote(texts.log + ": " + describe(finding));
  };
  auto reader = EventLogReader::open(texts.log, options);
  if (!reader.ok()) return failed(inFile(reader.error(), texts.log));
  auto writer = EventLogWriter::create(texts.output);
  if (!writer.ok()) return failed(inFile(writer.error(), texts.output));
  const auto counts = copyEvents(reader.value(), writer.value());
  if (!counts.ok()) {
    std::error_code ignored;
    std::filesystem::remove(texts.output, ignored);
    return failed(counts.error());
  }
  printOut(summary(texts, counts.value()));
  return ExitCode::Done;
}

}  // namespace

void addLogRecoverCommand(CLI::App& log, ExitCode& exit) {
  const auto texts = std::make_shared<RecoverTexts>();
  CLI::App* const command = log.add_subcommand(
      "recover", "Write every event that can be trusted into a new log with check sums");
  command->add_option("log", texts->log, "LCM event log")->type_name("LOG")->required();
  command->add_option("-o,--output", texts->output, "The new log; an existing file is refused")
      ->type_name("FILE")
      ->required();
  command->add_flag("--keep-tail", texts->keepTail,
                    "Also what follows the last check sum: of a writer that was killed");
  command->footer("Example:\n  foretouch log recover torn.lcmlog -o whole.lcmlog --keep-tail");
  command->callback([texts, &exit] { exit = recover(*texts); });
}

}  // namespace foretouch::tools
