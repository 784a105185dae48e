#include "tests/fuzz/log_inputs.h"

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "network/log/event_log_format.h"
#include "network/log/event_log_reader_access.h"
#include "tests/fuzz/promise.h"
#include "tests/support/log_in_memory.h"

namespace foretouch::fuzz {
namespace {

bool isSame(const LogEvent& a, const LogEvent& b) {
  return a.number == b.number && a.utimeUs == b.utimeUs && a.channel == b.channel &&
         a.payload == b.payload;
}

struct Read {
  std::vector<LogEvent> events;
  LogCounts counts;
};

std::vector<LogEvent> rest(EventLogReader& reader) {
  std::vector<LogEvent> events;
  for (LogEvent event;;) {
    const auto more = reader.next(event);
    require(more.ok(), "memory can be read");
    if (!more.value()) break;
    events.push_back(event);
  }
  LogEvent none;
  require(!reader.next(none).value(), "an end is an end");
  return events;
}

bool read(const Bytes& log, bool keepTail, Read& read) {
  LogReadOptions options;
  options.keepTail = keepTail;
  std::uint64_t reported = 0;
  options.onFinding = [&](const LogFinding& finding) {
    require(finding.offset <= log.size() && finding.bytes <= log.size() - finding.offset,
            "a finding is in the log");
    if (finding.damage != LogDamage::MissingBlocks && finding.damage != LogDamage::OtherLog &&
        finding.damage != LogDamage::UncheckedTail) {
      reported += finding.bytes;
    }
  };
  auto reader = EventLogReaderAccess::open(test::logInMemory(log), "input", options);
  if (!reader.ok()) {
    require(reader.error().file == "input", "an error names its file");
    require(!reader.error().message.empty(), "an error says what is wrong");
    return false;
  }
  read.events = rest(reader.value());
  read.counts = reader.value().counts();
  require(read.counts.events == read.events.size(), "events are counted");
  require(read.counts.skippedBytes == reported, "what is passed over is reported");
  require(read.counts.skippedBytes <= log.size(), "no byte is passed over twice");
  require(reader.value().position() <= log.size(), "the position is in the log");
  return true;
}

/// Every event is somewhere in the log, byte for byte, behind the one before.
void checkStandsInLog(const Bytes& log, const std::vector<LogEvent>& events) {
  auto from = log.begin();
  for (const LogEvent& event : events) {
    require(isLogChannel(event.channel) && event.channel != kLogBlockChannel,
            "channels are within their limits");
    Bytes bytes;
    appendEvent(bytes, event);
    const auto found = std::search(from, log.end(), bytes.begin(), bytes.end());
    require(found != log.end(), "what is given out stands in the log");
    from = found + static_cast<std::ptrdiff_t>(bytes.size());
  }
}

constexpr std::uint64_t kLogId = 0x1234'5678'9ABC'DEF0;

void appendBlock(Bytes& log, const std::vector<LogEvent>& events, BlockEvent& check) {
  Bytes block;
  for (const LogEvent& event : events) appendEvent(block, event);
  check.offset = log.size() + block.size();
  check.blockBytes = block.size();
  check.blockEvents = events.size();
  check.blockHash = blockHashOf(block, check.logId);
  log.insert(log.end(), block.begin(), block.end());
  appendBlockEvent(log, check);
  check.firstNumber += static_cast<std::int64_t>(events.size());
  check.previous = check.offset;
  ++check.number;
}

struct OwnLog {
  Bytes bytes;
  std::vector<LogEvent> events;
};

/// Blocks of 0 to 4 events; one of them with an event of another log as its payload.
OwnLog makeLog() {
  OwnLog log;
  BlockEvent check;
  check.logId = kLogId;
  appendBlock(log.bytes, {}, check);
  std::mt19937 random(7);
  for (int block = 0; block < 8; ++block) {
    std::vector<LogEvent> events;
    for (int i = block % 5; i > 0; --i) {
      LogEvent event;
      event.number = static_cast<std::int64_t>(log.events.size() + events.size());
      event.utimeUs = 1'000 * event.number;
      event.channel = "POSE";
      event.payload.resize(random() % 60);
      for (std::uint8_t& byte : event.payload) byte = static_cast<std::uint8_t>(random());
      if (i == 3) event.payload = log.bytes;  // the log itself, so far
      events.push_back(event);
    }
    check.utimeUs = check.latestUs = events.empty() ? check.utimeUs : events.back().utimeUs;
    check.earliestUs = events.empty() ? check.utimeUs : events.front().utimeUs;
    check.isLast = block == 7;
    appendBlock(log.bytes, events, check);
    log.events.insert(log.events.end(), events.begin(), events.end());
  }
  return log;
}

/// Changes, cuts out, doubles or moves bytes.
void damage(Bytes& log, unsigned kind, std::size_t at, std::size_t count) {
  if (log.empty()) return;
  at %= log.size();
  count = std::min(count % 1'024, log.size() - at);
  const auto first = log.begin() + static_cast<std::ptrdiff_t>(at);
  const auto last = first + static_cast<std::ptrdiff_t>(count);
  switch (kind % 5) {
    case 0: log[at] ^= static_cast<std::uint8_t>(1u << count % 8); break;
    case 1: log.erase(first, last); break;
    case 2: {
      const Bytes twice(first, last);
      log.insert(last, twice.begin(), twice.end());
      break;
    }
    case 3: std::fill(first, last, std::uint8_t{0}); break;
    default: log.resize(at); break;
  }
}

}  // namespace

bool feedLog(const std::uint8_t* data, std::size_t size) {
  const Bytes log(data, data + size);
  Read checked, kept;
  if (!read(log, false, checked)) return false;
  require(read(log, true, kept), "a log that opens opens");
  checkStandsInLog(log, kept.events);
  checkStandsInLog(log, checked.events);
  require(kept.events.size() >= checked.events.size() &&
              kept.events.size() <= checked.events.size() + checked.counts.tailEvents,
          "a tail adds its events");
  return !checked.events.empty();
}

bool feedLogDamage(const std::uint8_t* data, std::size_t size) {
  static const OwnLog own = makeLog();
  Bytes log = own.bytes;
  constexpr std::size_t kDamageBytes = 5, kMostDamages = 16;
  for (std::size_t i = 0; (i + 1) * kDamageBytes <= size && i < kMostDamages; ++i) {
    const std::uint8_t* const bytes = data + i * kDamageBytes;
    damage(log, bytes[0], static_cast<std::size_t>(bytes[1] << 8 | bytes[2]),
           static_cast<std::size_t>(bytes[3] << 8 | bytes[4]));
  }
  Read found;
  if (!read(log, false, found)) return false;
  // Blocks lost at both ends of every damage, and foreign reading where nothing of the log is left.
  if (found.counts.uncheckedEvents > 0) return false;
  auto from = own.events.begin();
  for (const LogEvent& event : found.events) {
    from = std::find_if(from, own.events.end(),
                        [&](const LogEvent& written) { return isSame(written, event); });
    require(from != own.events.end(), "only what was written is given out, in order");
    ++from;
  }
  return found.events.size() == own.events.size();
}

}  // namespace foretouch::fuzz
