// tests/network/log/log_samples.h: logs to read back, and a reader's complete report about one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "network/log/event_log.h"
#include "network/log/event_log_reader_access.h"
#include "tests/support/log_in_memory.h"
#include "tests/support/temp_folder.h"

namespace foretouch {

inline bool operator==(const LogEvent& a, const LogEvent& b) {
  return a.number == b.number && a.utimeUs == b.utimeUs && a.channel == b.channel &&
         a.payload == b.payload;
}

namespace test {

inline Bytes bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string writeBytes(const TempFolder& folder, const std::string& name,
                              const Bytes& bytes) {
  return folder.write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// The event whose payload follows from its number, so that a reader knows it alone.
inline LogEvent numberedEvent(std::int64_t number, std::size_t bytes) {
  LogEvent event;
  event.number = number;
  event.utimeUs = 1'700'000'000'000'000 + 1'000 * number;
  event.channel = number % 3 == 0 ? "FORETOUCH_POSE" : "OTHER_CHANNEL";
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  event.payload.resize(bytes);
  for (std::uint8_t& byte : event.payload) byte = static_cast<std::uint8_t>(random());
  return event;
}

inline std::vector<LogEvent> numberedEvents(int count, std::size_t bytes) {
  std::vector<LogEvent> events;
  for (int i = 0; i < count; ++i) events.push_back(numberedEvent(i, bytes));
  return events;
}

/// Written by EventLogWriter, closed.
inline Bytes ownLog(const std::vector<LogEvent>& events, const LogWriteOptions& options = {}) {
  const TempFolder folder;
  auto writer = EventLogWriter::create(folder / "own.lcmlog", options);
  EXPECT_TRUE(writer.ok());
  for (const LogEvent& event : events) {
    const auto written = writer.value().write(event.utimeUs, event.channel, event.payload);
    EXPECT_TRUE(written.ok()) << describe(written.error());
  }
  EXPECT_TRUE(writer.value().close().ok());
  return bytesOf(folder / "own.lcmlog");
}

/// As lcm-logger writes it; shares no code with ours.
inline Bytes foreignEvent(const LogEvent& event) {
  Bytes bytes;
  const auto append = [&](std::uint64_t word, int count) {
    for (int i = count - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(word >> 8 * i));
  };
  append(0xEDA1DA01, 4);
  append(static_cast<std::uint64_t>(event.number), 8);
  append(static_cast<std::uint64_t>(event.utimeUs), 8);
  append(event.channel.size(), 4);
  append(event.payload.size(), 4);
  bytes.insert(bytes.end(), event.channel.begin(), event.channel.end());
  bytes.insert(bytes.end(), event.payload.begin(), event.payload.end());
  return bytes;
}

inline void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

inline Bytes foreignLog(const std::vector<LogEvent>& events) {
  Bytes bytes;
  for (const LogEvent& event : events) append(bytes, foreignEvent(event));
  return bytes;
}

struct ReadLog {
  bool isOpen = false;
  Error error;
  std::vector<LogEvent> events;
  LogCounts counts;
  std::vector<LogFinding> findings;

  [[nodiscard]] bool found(LogDamage damage) const {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const LogFinding& finding) { return finding.damage == damage; });
  }
};

inline ReadLog readAll(EventLogReader reader) {
  ReadLog log;
  log.isOpen = true;
  for (LogEvent event;;) {
    const auto more = reader.next(event);
    if (!more.ok()) {
      log.error = more.error();
      break;
    }
    if (!more.value()) break;
    log.events.push_back(event);
  }
  log.counts = reader.counts();
  return log;
}

inline ReadLog readBytes(Bytes bytes, bool keepTail = false) {
  std::vector<LogFinding> findings;
  LogReadOptions options;
  options.keepTail = keepTail;
  options.onFinding = [&](const LogFinding& finding) { findings.push_back(finding); };
  auto reader = EventLogReaderAccess::open(logInMemory(std::move(bytes)), "log", options);
  ReadLog log;
  if (reader.ok()) {
    log = readAll(std::move(reader).value());
  } else {
    log.error = reader.error();
  }
  log.findings = std::move(findings);
  return log;
}

/// Whether `some` are events of `all`, in the same order.
inline bool isSubsequence(const std::vector<LogEvent>& some, const std::vector<LogEvent>& all) {
  auto from = all.begin();
  for (const LogEvent& event : some) {
    from = std::find(from, all.end(), event);
    if (from == all.end()) return false;
    ++from;
  }
  return true;
}

}  // namespace test
}  // namespace foretouch
