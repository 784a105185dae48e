// network/service/journal.h: a record of what a service took and said, written by a thread of its
// own: a disk that stalls delays no answer. What it cannot take is counted, never dropped silently.
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

/// Where events go: an event log, or whatever a test puts in its place. Used by one thread.
class JournalSink {
 public:
  virtual ~JournalSink() = default;
  /// An error loses this event; the next one is tried again.
  virtual Result<Done> write(std::int64_t utimeUs, const std::string& channel,
                             ByteView payload) = 0;
  virtual Result<Done> flush() = 0;
  virtual Result<Done> close() = 0;
};

/// A new event log (EventLogWriter); an existing file is refused.
[[nodiscard]] Result<std::unique_ptr<JournalSink>> createLogSink(const std::string& path);

struct JournalOptions {
  std::size_t maxEvents = 1u << 16;  ///< Waiting to be written.
  std::size_t maxBytes = 64u << 20;  ///< The same, payloads together.
  std::chrono::milliseconds flushEvery{100};
};

class Journal {
 public:
  /// `failed` is called once for each event, flush or close that failed, from any thread. Errors:
  /// no thread to be had.
  static Result<Journal> start(std::unique_ptr<JournalSink> sink, const JournalOptions& options,
                               std::function<void()> failed);
  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;
  ~Journal();  ///< As close().

  /// Never waits for the disk. What one thread adds is written in its order; what two threads add,
  /// in the order in which they called.
  void add(std::int64_t utimeUs, const std::string& channel, ByteView payload);
  /// Writes all that waits, and closes the log.
  void close();
  /// How long ago (ms) the writing thread last got on.
  [[nodiscard]] std::int64_t idleMs() const;
  /// The last thing that failed, for a person; empty where nothing has.
  [[nodiscard]] std::string lastFailure() const;

 private:
  struct Impl;
  explicit Journal(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
