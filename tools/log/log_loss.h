// tools/log/log_loss.h: reads the readable part of a log, and accounts for the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "network/log/event_log.h"

namespace foretouch::tools {

/// The unreadable parts of a log: where, how many bytes, and which events by their numbers.
class LogLoss {
 public:
  [[nodiscard]] bool any() const { return findings_ > 0 || counts_.badEvents > 0; }
  /// One line per damage, at most kMaxTold of them, and one with the sums; none where !any().
  [[nodiscard]] std::vector<std::string> lines() const;
  /// The reader's own, at the end.
  [[nodiscard]] const LogCounts& counts() const { return counts_; }

  static constexpr std::size_t kMaxTold = 10;

  // Called by readEvents(), in the order of the log.
  void found(const LogFinding& finding);
  void read(const LogEvent& event, const LogCounts& counts);
  void ended(const LogCounts& counts);

 private:
  void tell(std::string line);

  std::vector<std::string> told_;
  LogCounts counts_;
  std::uint64_t findings_ = 0, untold_ = 0, eventsRead_ = 0;
  std::uint64_t missingEvents_ = 0, tailBytes_ = 0;
  /// Since the last event: was there damage, and how many bytes were skipped?
  bool isDamagedSince_ = false;
  std::uint64_t bytesSince_ = 0;
  std::int64_t lastNumber_ = -1, lastUs_ = 0;
};

/// An event, and how far the reader has come; false ends the reading early.
using EventSink = std::function<Result<bool>(const LogEvent& event, const EventLogReader& log)>;

/// Passes every trustworthy event to `sink`, as EventLogReader does, and records the rest in
/// `loss`. Errors: opening, reading, or the sink's; an error without a file names the log.
[[nodiscard]] Result<LogCounts> readEvents(const std::string& path, LogLoss& loss,
                                           const EventSink& sink);

}  // namespace foretouch::tools
