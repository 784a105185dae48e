#include "tools/log/log_recover_command.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

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
  bool keepTail = false, isUnchecked = false, asJson = false;
};

/// Lines of what is damaged, before a count.
constexpr std::size_t kMostToldFindings = 10;
/// Events out of order are sorted in memory.
constexpr std::size_t kMostSortedBytes = std::size_t{1} << 30;

/// Passes all that it reads to `take`.
template <typename Take>
Result<Done> forEachEvent(EventLogReader& reader, const Take& take) {
  ProgressBar bar("recover", static_cast<std::int64_t>(reader.size()));
  for (LogEvent event;;) {
    FORETOUCH_TRY(const auto more, reader.next(event));
    if (!more) return Done{};
    FORETOUCH_CHECK(take(event));
    bar.advanceTo(static_cast<std::int64_t>(reader.position()));
  }
}

Result<Done> writeTo(EventLogWriter& writer, const LogEvent& event) {
  return writer.write(event.utimeUs, event.channel, event.payload);
}

/// Copies events by stamps, those with one stamp by their numbers, if these still mean anything.
Result<Done> copySorted(EventLogReader& reader, EventLogWriter& writer) {
  std::vector<LogEvent> events;
  std::size_t bytes = 0;
  FORETOUCH_CHECK(forEachEvent(reader, [&](const LogEvent& event) -> Result<Done> {
    bytes += sizeof event + event.channel.size() + event.payload.size();
    if (bytes > kMostSortedBytes) {
      return Error::of(ErrorCode::LimitExceeded,
                       "its events are out of order; expected at most 1 GiB of them to sort");
    }
    events.push_back(event);
    return Done{};
  }));
  std::stable_sort(events.begin(), events.end(), [](const LogEvent& x, const LogEvent& y) {
    return std::tie(x.utimeUs, x.number) < std::tie(y.utimeUs, y.number);
  });
  for (const LogEvent& event : events) FORETOUCH_CHECK(writeTo(writer, event));
  return Done{};
}

/// Whether stamps never fall.
Result<bool> isInOrder(const Recovery& asked, const LogReadOptions& options) {
  LogReadOptions quiet = options;
  quiet.onFinding = nullptr;
  FORETOUCH_TRY(auto reader, EventLogReader::open(asked.log, quiet));
  std::int64_t lastUs = std::numeric_limits<std::int64_t>::min();
  bool isAscending = true;
  FORETOUCH_CHECK(forEachEvent(reader, [&](const LogEvent& event) -> Result<Done> {
    isAscending = isAscending && event.utimeUs >= lastUs;
    lastUs = event.utimeUs;
    return Done{};
  }));
  return isAscending;
}

/// Copies the trustworthy events of the one into the other.
Result<LogCounts> copyEvents(const Recovery& asked, const LogReadOptions& options,
                             EventLogReader& reader, EventLogWriter& writer) {
  bool isSorted = true;
  if (asked.isUnchecked) {
    FORETOUCH_TRY(isSorted, isInOrder(asked, options));
  }
  if (isSorted) {
    FORETOUCH_CHECK(
        forEachEvent(reader, [&](const LogEvent& event) { return writeTo(writer, event); }));
  } else {
    printNote(asked.log + ": its events are out of order: they are sorted by their stamps");
    FORETOUCH_CHECK(copySorted(reader, writer));
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
  if (asked.isUnchecked) {
    text += "nothing shows that these are all, that they are as they were written, or in order\n";
  }
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
  out.field("check_sums_ignored", asked.isUnchecked);
  out.field("bytes_lost", counts.skippedBytes);
  out.endObject();
  return text + "\n";
}

void dropOutput(const Recovery& asked) {
  std::error_code ignored;
  std::filesystem::remove(asked.output, ignored);
}

/// An empty log is of no use.
ExitCode nothingToRecover(const Recovery& asked, const LogCounts& counts) {
  dropOutput(asked);
  printError(asked.log + ": no event of it can be trusted" +
             (counts.badBlocks + counts.missingBlocks > 0
                  ? "; --unchecked takes events that other tools renumbered, merged or filtered"
                  : ""));
  return ExitCode::CheckSaysNo;
}

ExitCode recover(const Recovery& asked) {
  LogReadOptions options;
  options.keepTail = asked.keepTail;
  options.ignoreCheckSums = asked.isUnchecked;
  std::size_t findings = 0;
  options.onFinding = [&](const LogFinding& finding) {
    if (++findings <= kMostToldFindings) printNote(asked.log + ": " + describe(finding));
  };
  FORETOUCH_TRY_OR(failed, auto reader, EventLogReader::open(asked.log, options));
  FORETOUCH_TRY_OR(failed, auto writer, EventLogWriter::create(asked.output));
  const auto counts = copyEvents(asked, options, reader, writer);
  if (findings > kMostToldFindings) {
    printNote(fmt::format("{}: and {} more", asked.log, findings - kMostToldFindings));
  }
  if (counts.ok() && counts.value().events == 0) {
    return nothingToRecover(asked, counts.value());
  }
  if (!counts.ok()) {
    dropOutput(asked);
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
  settings.flag("--unchecked", asked->isUnchecked,
                "Every whole event, whatever check sums say: of a log that other tools renumbered, "
                "merged, filtered or shuffled");
  settings.asJson(asked->asJson);
  Command command{"recover", "Write every event that can be trusted into a new log with check sums",
                  "Example:\n  foretouch log recover torn.lcmlog -o whole.lcmlog --keep-tail",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return recover(*asked); };
  return command;
}

}  // namespace foretouch::tools
