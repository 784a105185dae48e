// tools/log/log_inspection.h: facts about an event log that do not depend on its messages' meaning.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "network/log/event_log.h"

namespace foretouch::tools {

struct ChannelFacts {
  std::uint64_t events = 0;
  std::uint64_t payloadBytes = 0;
  std::int64_t earliestUs = 0, latestUs = 0;

  void add(std::int64_t utimeUs, std::size_t bytes);
  /// Events per second; 0 if all have the same stamp.
  [[nodiscard]] double rateHz() const;
  [[nodiscard]] double durationS() const;
};

/// Limits on the lists of channels and findings; counts those beyond.
inline constexpr std::size_t kMaxListedChannels = 1000;
inline constexpr std::size_t kMaxListedFindings = 1000;

struct LogInspection {
  std::string path;
  std::uint64_t bytes = 0;
  LogCounts counts;
  ChannelFacts all;
  std::map<std::string, ChannelFacts> channels;
  ChannelFacts otherChannels;         ///< Facts on the channels beyond kMaxListedChannels.
  std::uint64_t stampsBackwards = 0;  ///< Events with an earlier stamp than the one before.
  std::vector<LogFinding> findings;
  std::uint64_t unlistedFindings = 0;

  [[nodiscard]] bool isSound() const;
};

/// Reads the whole log. A bar on stderr shows how far.
[[nodiscard]] Result<LogInspection> inspectLog(const std::string& path);

/// "own, closed", "LCM, without check sums", ...
[[nodiscard]] std::string formatOf(const LogCounts& counts);
/// One line: "bytes 120 to 4,096: bad block (3,976 bytes)".
[[nodiscard]] std::string describe(const LogFinding& finding);
/// Readable text, several lines.
[[nodiscard]] std::string describe(const LogInspection& inspection);
/// One line of JSON (docs/formats.md, "Event logs").
[[nodiscard]] std::string jsonLine(const LogInspection& inspection);
[[nodiscard]] std::string jsonLine(const std::string& path, const Error& error);

}  // namespace foretouch::tools
