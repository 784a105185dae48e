// network/log/event_log.h: LCM event logs, as lcm-logger writes and lcm-logplayer reads them. Ours
// add check sums, which those tools skip.
//
// An event: u32 0xEDA1DA01, i64 event number, i64 utime (us), i32 channel bytes, i32 payload bytes,
// channel, payload; big-endian. Source: lcm-proj/lcm, docs/content/log-file-format.md. A log has no
// check sums of its own. Ours adds an event on kLogBlockChannel after every block of events: XXH64
// of the block's bytes, its number of events, and the place of the last such event
// (docs/formats.md, "Event logs"). So a reader can verify each block, and find an index from the
// end backwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/wire/codec.h"

namespace foretouch {

inline constexpr char kLogBlockChannel[] = "FORETOUCH_LOG_BLOCK";

/// Longest channel in a log, in bytes: liblcm's own reader refuses longer ones.
inline constexpr std::size_t kMaxLogChannelBytes = 999;
/// Largest payload in a log, in bytes; foreign logs may have larger ones than the wire carries.
inline constexpr std::size_t kMaxLogPayloadBytes = 16u << 20;
/// Largest LogWriteOptions::blockBytes.
inline constexpr std::size_t kMaxLogBlockBytes = 1u << 20;

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t utimeUs = 0;  ///< Time of receipt.
  std::string channel;
  Bytes payload;
};

struct LogCounts {
  std::uint64_t events = 0;     ///< Returned by next().
  std::uint64_t blocks = 0;     ///< With a correct check sum.
  std::uint64_t badBlocks = 0;  ///< With a wrong check sum: next() returns none of their events.
  std::uint64_t missingBlocks = 0;    ///< By the numbers of the blocks around: their check sum is
                                      ///< gone.
  std::uint64_t uncheckedEvents = 0;  ///< Returned from a log without check sums.
  std::uint64_t tailEvents = 0;       ///< After the last check sum of a log that has them.
  std::uint64_t skippedBytes = 0;     ///< Between events: damage.
  std::uint64_t badEvents = 0;        ///< Headers with impossible lengths.
  bool isTruncated = false;           ///< Ends within an event.
  bool hasCheckSums = false;          ///< next() returns events of whole blocks only.
  bool isClosed = false;  ///< The last block with a correct check sum is marked as the last.
};

enum class LogDamage : std::uint8_t {
  Skipped,        ///< Bytes outside every trustworthy block or event.
  BadBlock,       ///< Its check sum is wrong.
  MissingBlocks,  ///< `count` of them, by the numbers of the blocks around.
  RepeatedBlock,  ///< A repeated block, or one out of order.
  UncheckedTail,  ///< `count` events after the last check sum.
  Truncated,      ///< The end of the file within an event.
  OtherLog,       ///< Another log begins behind a tail or damage; the reader ignores it.
};
/// "skipped bytes", "bad block", ...
[[nodiscard]] const char* toString(LogDamage damage);

struct LogFinding {
  LogDamage damage = LogDamage::Skipped;
  std::uint64_t offset = 0, bytes = 0;  ///< In the file.
  std::uint64_t count = 0;              ///< For the kinds that mention it.
};

struct LogReadOptions {
  /// Also return the events after the last check sum: the writer was killed before it closed their
  /// block, and only their lengths show that they are whole.
  bool keepTail = false;
  /// Return every event whose lengths are possible, as of a log without check sums: other tools
  /// renumber, merge and leave out events, and no block's check sum is right any more.
  bool ignoreCheckSums = false;
  /// Called for every damage that the reader skips.
  std::function<void(const LogFinding&)> onFinding;
};

/// Reads any file in order, in bounded memory (below 64 MiB at worst, 1 MiB for our writer's logs).
/// Skips and counts bad bytes up to the next event; never fatal. Does not return events on
/// kLogBlockChannel.
class EventLogReader {
 public:
  /// Errors: not found, unreadable, not a regular file, without any event.
  static Result<EventLogReader> open(const std::string& path, const LogReadOptions& options = {});
  EventLogReader(EventLogReader&&) noexcept;
  EventLogReader& operator=(EventLogReader&&) noexcept;
  ~EventLogReader();

  /// False at the end. Errors: reading failed.
  [[nodiscard]] Result<bool> next(LogEvent& event);
  [[nodiscard]] const LogCounts& counts() const;
  /// Bytes read so far, for progress.
  [[nodiscard]] std::uint64_t position() const;
  [[nodiscard]] std::uint64_t size() const;

 private:
  friend struct EventLogReaderAccess;  // network/log/event_log_reader_access.h
  struct Impl;
  explicit EventLogReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

struct LogWriteOptions {
  std::size_t blockBytes = 64u << 10;  ///< Closes a block at this size, 1 to kMaxLogBlockBytes,
  std::int64_t blockUs = 100'000;      ///< ... or this long after its first event's stamp ...
  bool syncBlocks = false;             ///< fdatasync after each.
};

/// Appends events. If the process is killed at any instant, the log still opens, with all closed
/// blocks whole.
class EventLogWriter {
 public:
  /// Creates a new file that its owner alone can read; an existing one is an error, never
  /// overwritten.
  static Result<EventLogWriter> create(const std::string& path,
                                       const LogWriteOptions& options = {});
  EventLogWriter(EventLogWriter&&) noexcept;
  EventLogWriter& operator=(EventLogWriter&&) noexcept;
  ~EventLogWriter();  ///< As close(), but ignores errors.

  /// Sets the event's number. An error (a full disk) loses this event only: the log stays readable,
  /// and the writer keeps earlier events for the next try, on an event boundary. Refuses a channel
  /// that is kLogBlockChannel, empty, too long or has control characters, and a payload beyond
  /// kMaxLogPayloadBytes.
  [[nodiscard]] Result<Done> write(std::int64_t utimeUs, const std::string& channel,
                                   ByteView payload);
  /// Closes the current block, so that others can read and verify everything written so far.
  [[nodiscard]] Result<Done> flush();
  /// Marks the log as closed. After an error you can try again.
  [[nodiscard]] Result<Done> close();

 private:
  struct Impl;
  explicit EventLogWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
