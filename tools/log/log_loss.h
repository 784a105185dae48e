// tools/log/log_loss.h: a log read for what can be read of it, with an account of the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "network/log/event_log.h"

namespace foretouch::tools {

/// What of a log could not be read: where, how many bytes, and which events by their numbers.
class LogLoss {
 public:
  [[nodiscard]] bool any() const { return findings_ > 0 || counts_.badEvents > 0; }
  /// One line per damage, at most kMaxTold of them, and one with the sums; none where !any().
  [[nodiscard]] std::vector<std::string> lines() const;
  /// The reader's own, once all has been read.
  [[nodiscard]] const LogCounts& counts() const { return counts_; }

  static constexpr std::size_t kMaxTold = 20;

  // What readEvents() tells it, in the order of the log.
  void found(const LogFinding& finding);
  void read(const LogEvent& event, const LogCounts& counts);
  void ended(const LogCounts& counts);

 private:
  void tell(std::string line);

  std::vector<std::string> told_;
  LogCounts counts_;
  std::uint64_t findings_ = 0, untold_ = 0, eventsRead_ = 0;
  std::uint64_t missingEvents_ = 0, tailBytes_ = 0;
  /// Since the last event: was anything found, and how many bytes were passed over?
  bool isDamagedSince_ = false;
  std::uint64_t bytesSince_ = 0;
  std::int64_t lastNumber_ = -1, lastUs_ = 0;
};

/// An event, and how far the reader has come; false ends the reading early.
using EventSink = std::function<Result<bool>(const LogEvent& event, const EventLogReader& log)>;

/// Gives out every event that can be trusted, as EventLogReader does, and tells `loss` what cannot.
/// The error is one of opening, of reading, or the sink's; it names the log where it names nothing.
[[nodiscard]] Result<LogCounts> readEvents(const std::string& path, LogLoss& loss,
                                           const EventSink& sink);

}  // namespace foretouch::tools
