// network/service/journal.h: a record of a service's input and output. A separate thread writes it,
// so a slow disk delays no answer. Counts every event that it cannot write; never drops one
// silently. Not installed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "articulated/result.h"
#include "network/wire/codec.h"

namespace foretouch {

/// The destination of events: an event log, or a test's own. Used by one thread.
class JournalSink {
 public:
  virtual ~JournalSink() = default;
  /// An error loses only this event.
  virtual Result<Done> write(std::int64_t utimeUs, const std::string& channel,
                             ByteView payload) = 0;
  virtual Result<Done> flush() = 0;
  virtual Result<Done> close() = 0;
};

struct LogLimits {
  std::uint64_t bytes = 0;  ///< In one file, before the next one begins; 0: no limit.
  int files = 8;            ///< Kept; the oldest goes when another one begins. At least 1.
};

/// A new event log (EventLogWriter); an existing file is an error. Beyond the limit it goes on in
/// "today.2.lcmlog" and so on, each with the last skeletons at its begin, passes over names that
/// are taken, and removes the oldest of those that it made. `skeletonChannel`: whose payloads these
/// are.
[[nodiscard]] Result<std::unique_ptr<JournalSink>> createLogSink(
    const std::string& path, const LogLimits& limits = {}, const std::string& skeletonChannel = "");

struct JournalOptions {
  std::size_t maxEvents = 1u << 16;  ///< Waiting for the disk.
  std::size_t maxBytes = 64u << 20;  ///< Waiting payloads, in total.
  std::chrono::milliseconds flushEvery{100};
  /// Then a disk that stalls keeps the rest. The rest of a service's end has a fifth second: a
  /// supervisor is promised five.
  std::chrono::milliseconds closeWithin{4000};
};

class Journal {
 public:
  /// Calls `failed` once for each failed event, flush or close, from any thread. Errors: the system
  /// gives no thread.
  static Result<Journal> start(std::unique_ptr<JournalSink> sink, const JournalOptions& options,
                               std::function<void()> failed);
  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;
  ~Journal();  ///< As close(). Calls `failed` no more.

  /// Never waits for the disk. Writes events in the order of the calls, also across threads.
  void add(std::int64_t utimeUs, const std::string& channel, ByteView payload);
  /// Writes everything that waits, and closes the log; if that takes longer than
  /// JournalOptions::closeWithin, leaves it to its thread, and counts what waits as failed.
  void close();
  /// Milliseconds since the writing thread last made progress.
  [[nodiscard]] std::int64_t idleMs() const;
  /// The last failure, as text; empty if there was none.
  [[nodiscard]] std::string lastFailure() const;

 private:
  struct Impl;
  explicit Journal(std::shared_ptr<Impl> impl);
  std::shared_ptr<Impl> impl_;  // the thread's, too
};

}  // namespace foretouch
