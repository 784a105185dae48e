#include "tools/log/log_recover_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "tools/log/log_inspection.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct Recovery {
  std::string log, output;
  bool keepTail = false, asJson = false;
};

/// Copies the trustworthy events of the one into the other.
Result<LogCounts> copyEvents(EventLogReader& reader, EventLogWriter& writer) {
  ProgressBar bar("recover", static_cast<std::int64_t>(reader.size()));
  for (LogEvent event;;) {
    FORETOUCH_TRY(const auto more, reader.next(event));
    if (!more) break;
    FORETOUCH_CHECK(writer.write(event.utimeUs, event.channel, event.payload));
    bar.advanceTo(static_cast<std::int64_t>(reader.position()));
  }
  FORETOUCH_CHECK(writer.close());
  return reader.counts();
}

std::string summary(const Recovery& asked, const LogCounts& counts) {
  std::string text =
      fmt::format("{}: {} events written to {}\n", asked.log, counts.events, asked.output);
  const auto add = [&text](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("  {:<25}{}\n", what, count);
  };
  add(counts.uncheckedEvents, "that nothing checked");
  add(counts.badBlocks, "bad blocks");
  add(counts.missingBlocks, "missing blocks");
  add(counts.badEvents, "bad events");
  add(counts.tailEvents, asked.keepTail ? "unchecked tail, kept" : "unchecked tail, left out");
  add(counts.skippedBytes, "bytes lost");
  return text;
}

std::string recoveryJson(const Recovery& asked, const LogCounts& counts) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("log", asked.log);
  out.field("output", asked.output);
  out.field("events", counts.events);
  out.field("unchecked_events", counts.uncheckedEvents);
  out.field("bad_blocks", counts.badBlocks);
  out.field("missing_blocks", counts.missingBlocks);
  out.field("bad_events", counts.badEvents);
  out.field("tail_events", counts.tailEvents);
  out.field("tail_kept", asked.keepTail);
  out.field("bytes_lost", counts.skippedBytes);
  out.endObject();
  return text + "\n";
}

ExitCode recover(const Recovery& asked) {
  LogReadOptions options;
  options.keepTail = asked.keepTail;
  std::size_t findings = 0;
  options.onFinding = [&](const LogFinding& finding) {
    if (++findings <= kMaxListedFindings) printNote(asked.log + ": " + describe(finding));
  };
  FORETOUCH_TRY_OR(failed, auto reader, EventLogReader::open(asked.log, options));
  FORETOUCH_TRY_OR(failed, auto writer, EventLogWriter::create(asked.output));
  const auto counts = copyEvents(reader, writer);
  if (!counts.ok()) {
    std::error_code ignored;
    std::filesystem::remove(asked.output, ignored);
    return failed(counts.error());
  }
  printOut(asked.asJson ? recoveryJson(asked, counts.value()) : summary(asked, counts.value()));
  return ExitCode::Done;
}

}  // namespace

Command logRecoverCommand() {
  const auto asked = std::make_shared<Recovery>();
  Settings settings;
  settings.path("log", "LOG", asked->log, "LCM event log").files("lcmlog").required("an event log");
  settings.output("-o,--output", "FILE", asked->output, "The new log; an existing file is refused")
      .required();
  settings.flag("--keep-tail", asked->keepTail,
                "Also what follows the last check sum: of a writer that was killed");
  settings.asJson(asked->asJson);
  Command command{"recover", "Write every event that can be trusted into a new log with check sums",
                  "Example:\n  foretouch log recover torn.lcmlog -o whole.lcmlog --keep-tail",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return recover(*asked); };
  return command;
}

}  // namespace foretouch::tools
