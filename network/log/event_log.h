// network/log/event_log.h: LCM event logs: what lcm-logger writes and lcm-logplayer reads, ours
// with check sums that they pass over.
//
// An event: u32 0xEDA1DA01, i64 event number, i64 utime (us), i32 channel bytes, i32 payload bytes,
// channel, payload; big-endian. Source: lcm-proj/lcm, docs/content/log-file-format.md. A log has no
// check sums of its own. Ours adds an event on kLogBlockChannel after every block of events: XXH64
// of the block's bytes, how many events it has, and where the last such event stands
// (docs/formats.md, "Event logs"); so a block is known to be whole, and an index is found from the
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

/// Longest channel in a log, in bytes: liblcm's own reader takes no longer ones.
inline constexpr std::size_t kMaxLogChannelBytes = 999;
/// Largest payload in a log, in bytes; foreign logs may have larger ones than the wire carries.
inline constexpr std::size_t kMaxLogPayloadBytes = 16u << 20;
/// Largest LogWriteOptions::blockBytes.
inline constexpr std::size_t kMaxLogBlockBytes = 1u << 20;

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t utimeUs = 0;  ///< When it was received.
  std::string channel;
  Bytes payload;
};

struct LogCounts {
  std::uint64_t events = 0;     ///< Given out.
  std::uint64_t blocks = 0;     ///< Whose check sum was right.
  std::uint64_t badBlocks = 0;  ///< Whose check sum was wrong: none of their events is given out.
  std::uint64_t missingBlocks = 0;    ///< By the numbers of those around: their check sum is gone.
  std::uint64_t uncheckedEvents = 0;  ///< Given out of a log without check sums.
  std::uint64_t tailEvents = 0;       ///< After the last check sum of a log that has them.
  std::uint64_t skippedBytes = 0;     ///< Between events: damage that was passed over.
  std::uint64_t badEvents = 0;        ///< Headers with impossible lengths.
  bool isTruncated = false;           ///< Ends within an event.
  bool hasCheckSums = false;          ///< Events are given out from whole blocks only.
  bool isClosed = false;  ///< The last block whose check sum was right says that it is the last.
};

enum class LogDamage : std::uint8_t {
  Skipped,        ///< Bytes that belong to no block, or to no event, that can be trusted.
  BadBlock,       ///< Its check sum is wrong.
  MissingBlocks,  ///< `count` of them, by the numbers of the blocks around.
  RepeatedBlock,  ///< A block that was there before, or out of order.
  UncheckedTail,  ///< `count` events after the last check sum.
  Truncated,      ///< The end of the file within an event.
  OtherLog,       ///< Another log begins behind a tail or damage: it is not read.
};
/// "skipped bytes", "bad block", ...
[[nodiscard]] const char* toString(LogDamage damage);

struct LogFinding {
  LogDamage damage = LogDamage::Skipped;
  std::uint64_t offset = 0, bytes = 0;  ///< In the file.
  std::uint64_t count = 0;              ///< Where the kind says so.
};

struct LogReadOptions {
  /// Also give out what follows the last check sum: events whose writer was killed before the block
  /// was closed, whole by their lengths alone.
  bool keepTail = false;
  /// Called for every damage when it is passed over.
  std::function<void(const LogFinding&)> onFinding;
};

/// Reads any file in order, in bounded memory (below 64 MiB at worst, 1 MiB for what our writer
/// writes): bad bytes are passed over up to the next event, counted, never fatal. Events on
/// kLogBlockChannel are not given out.
class EventLogReader {
 public:
  /// Errors: not found, unreadable, no regular file, not a single event in it.
  static Result<EventLogReader> open(const std::string& path, const LogReadOptions& options = {});
  EventLogReader(EventLogReader&&) noexcept;
  EventLogReader& operator=(EventLogReader&&) noexcept;
  ~EventLogReader();

  /// False at the end. The error is one of reading.
  [[nodiscard]] Result<bool> next(LogEvent& event);
  [[nodiscard]] const LogCounts& counts() const;
  /// Bytes read of all, for progress.
  [[nodiscard]] std::uint64_t position() const;
  [[nodiscard]] std::uint64_t size() const;
  /// The next event is the first one at or after `utimeUs` in a log whose stamps grow and whose
  /// blocks are in order; by the index where there are check sums, else from the start. Counts
  /// start anew.
  [[nodiscard]] Result<Done> seek(std::int64_t utimeUs);

 private:
  friend struct EventLogReaderAccess;  // network/log/event_log_reader_access.h
  struct Impl;
  explicit EventLogReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

struct LogWriteOptions {
  std::size_t blockBytes = 64u << 10;  ///< A block is closed at this size, 1 to kMaxLogBlockBytes,
  std::int64_t blockUs = 100'000;      ///< ... or this long after its first event's stamp ...
  bool syncBlocks = false;             ///< fdatasync after each.
};

/// Appends events. A kill at any instant leaves a log that opens, with all closed blocks whole.
class EventLogWriter {
 public:
  /// A new file; an existing one is refused, never overwritten.
  static Result<EventLogWriter> create(const std::string& path,
                                       const LogWriteOptions& options = {});
  EventLogWriter(EventLogWriter&&) noexcept;
  EventLogWriter& operator=(EventLogWriter&&) noexcept;
  ~EventLogWriter();  ///< As close(), with errors lost.

  /// Numbers the event itself. An error (a full disk) loses this event, and says so; the log stays
  /// readable, events that were taken before are kept for the next try, on a boundary. Refuses a
  /// channel that is kLogBlockChannel, empty, too long or with control characters, and a payload
  /// beyond kMaxLogPayloadBytes.
  [[nodiscard]] Result<Done> write(std::int64_t utimeUs, const std::string& channel,
                                   ByteView payload);
  /// Closes the block at hand, so that what has been written can be read by others, checked.
  [[nodiscard]] Result<Done> flush();
  /// Marks the log as closed. After an error it can be tried again.
  [[nodiscard]] Result<Done> close();

 private:
  struct Impl;
  explicit EventLogWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
