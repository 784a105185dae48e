#include "tools/log/log_loss.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "network/log/event_log_format.h"
#include "tools/console.h"
#include "tools/log/log_inspection.h"

namespace foretouch::tools {
namespace {

std::string counted(std::uint64_t count, const char* one, const char* many) {
  return count == 0 ? "" : fmt::format(", {} {}", count, count == 1 ? one : many);
}

std::string gapLine(std::uint64_t first, std::uint64_t missing, std::int64_t fromUs,
                    std::int64_t toUs) {
  const std::string which = missing == 1
                                ? fmt::format("event {} is", first)
                                : fmt::format("events {} to {} are", first, first + missing - 1);
  return first == 0 ? fmt::format("{} missing: before stamp {} us", which, toUs)
                    : fmt::format("{} missing: between stamps {} and {} us", which, fromUs, toUs);
}

}  // namespace

void LogLoss::tell(std::string line) {
  if (told_.size() < kMaxTold) {
    told_.push_back(std::move(line));
  } else {
    ++untold_;
  }
}

void LogLoss::found(const LogFinding& finding) {
  ++findings_;
  isDamagedSince_ = true;
  // If there are bytes between blocks, another finding reports them.
  if (finding.damage != LogDamage::MissingBlocks) bytesSince_ += finding.bytes;
  if (finding.damage == LogDamage::UncheckedTail) {
    missingEvents_ += finding.count;
    tailBytes_ += finding.bytes;  // all others are in LogCounts::skippedBytes
  }
  tell(describe(finding));
}

void LogLoss::read(const LogEvent& event, const LogCounts& counts) {
  const std::int64_t next = lastNumber_ + 1;
  if (isDamagedSince_ && next >= 0 && event.number > next) {
    const auto missing = static_cast<std::uint64_t>(event.number - next);
    // Without check sums a number may also be damaged: that many events must fit into the bytes.
    if (counts.hasCheckSums || missing <= bytesSince_ / kEventHeaderBytes) {
      missingEvents_ += missing;
      tell(gapLine(static_cast<std::uint64_t>(next), missing, lastUs_, event.utimeUs));
    }
  }
  isDamagedSince_ = false;
  bytesSince_ = 0;
  lastNumber_ = std::max<std::int64_t>(event.number, -1);
  lastUs_ = event.utimeUs;
  ++eventsRead_;
}

void LogLoss::ended(const LogCounts& counts) {
  counts_ = counts;
  if (isDamagedSince_ && eventsRead_ > 0) {
    tell(fmt::format("nothing is read after event {}, stamp {} us", lastNumber_, lastUs_));
  }
}

std::vector<std::string> LogLoss::lines() const {
  if (!any()) return {};
  std::vector<std::string> lines = told_;
  if (untold_ > 0) {
    lines.push_back(fmt::format("and {} more: foretouch log check lists them", untold_));
  }
  const std::string lost = counted(counts_.badBlocks, "bad block", "bad blocks") +
                           counted(counts_.missingBlocks, "missing block", "missing blocks") +
                           counted(counts_.badEvents, "impossible event", "impossible events") +
                           counted(missingEvents_, "event", "events") +
                           counted(counts_.skippedBytes + tailBytes_, "byte", "bytes");
  lines.push_back(fmt::format("damaged: {} {} read; lost{}", eventsRead_,
                              eventsRead_ == 1 ? "event was" : "events were",
                              lost.empty() ? " is what follows" : ":" + lost.substr(1)));
  return lines;
}

Result<LogCounts> readEvents(const std::string& path, LogLoss& loss, const EventSink& sink) {
  LogReadOptions options;
  options.onFinding = [&loss](const LogFinding& finding) { loss.found(finding); };
  FORETOUCH_TRY(auto log, EventLogReader::open(path, options));
  for (LogEvent event;;) {
    FORETOUCH_TRY(const auto more, log.next(event));
    if (!more) break;
    loss.read(event, log.counts());
    FORETOUCH_TRY(const auto wanted, inFile(sink(event, log), path));
    if (!wanted) return log.counts();
  }
  loss.ended(log.counts());
  return log.counts();
}

}  // namespace foretouch::tools
