// network/log/event_log_blocks.h: the events of a log with check sums, a block at a time; and those
// of one without, as they are framed.
#pragma once

#include <cstdint>
#include <optional>

#include "network/log/event_log_window.h"

namespace foretouch {

/// Gives out a block's events once its hash has been seen to be right, and no others.
///
/// Blocks are found twice over. By framing, from the end of the last block on: what a sound log
/// needs. Where that ends anywhere but at a block event whose block begins there, by searching the
/// same bytes for the next intact block event of this log: a wrong length, garbage or a lost block
/// event so costs its own block alone. The log's id is in every block event, so bytes of another
/// log inside a payload are never taken for this one's.
class CheckedBlocks {
 public:
  CheckedBlocks(LogWindow& window, LogCounts& counts, const LogReadOptions& options)
      : window_(window), counts_(counts), options_(options) {}

  /// From `offset` on, where block `number` of this log is expected. Without an id nothing is
  /// believed but a tail.
  void start(std::uint64_t offset, std::optional<std::uint64_t> logId, std::uint64_t number = 0);

  /// False at the end.
  bool next(LogEvent& event);
  [[nodiscard]] std::uint64_t position() const;

 private:
  /// The next block with events in it becomes the one at hand.
  bool findBlock();
  bool walk(BlockEvent& event, std::uint64_t& at);
  bool scan(BlockEvent& event, std::uint64_t& at);
  bool verifies(const BlockEvent& event, std::uint64_t at);
  void consider(const BlockEvent& event, std::uint64_t at);
  void judgeNumber(const BlockEvent& event, std::uint64_t at);
  void advanceTo(std::uint64_t offset);
  void findTail();
  void passOver(LogDamage damage, std::uint64_t from, std::uint64_t to);
  void report(LogDamage damage, std::uint64_t from, std::uint64_t to, std::uint64_t count = 0);

  LogWindow& window_;
  LogCounts& counts_;
  const LogReadOptions& options_;
  std::optional<std::uint64_t> logId_;
  std::uint64_t expected_ = 0;  ///< Number of the next block event.
  std::uint64_t next_ = 0;      ///< Where the next block begins.
  /// Bytes that may be framed beyond `next_`, in all: keeps a log that is made to be framed in vain
  /// from being framed again and again.
  std::uint64_t walkCredit_ = 0;
  bool isTail_ = false;
  std::uint64_t cursor_ = 0, end_ = 0;  ///< What is left of the block at hand, or of the tail.
};

/// An event of a log without check sums, and what was passed over to find it.
struct FoundFrame {
  Frame frame;
  bool isFound = false;
  std::uint64_t impossible = 0;  ///< Headers that cannot be.
  bool isTorn = false;           ///< Not found; the log ends within an event.
};

/// The first event at or after `offset` that begins before `limit`. One that ends where no other
/// begins is believed only if no event inside it does better: its length is what is damaged then.
[[nodiscard]] FoundFrame findFrame(LogWindow& window, std::uint64_t offset, std::uint64_t limit);

/// Where a log begins, and how it is to be read.
struct LogKind {
  bool isEmpty = false;  ///< Not a single event.
  bool hasCheckSums = false;
  std::optional<std::uint64_t> logId;
};

/// By the events that begin within kMaxBlockSpan of the first one: a log of ours has an intact
/// block event among them, at its very start if nothing is damaged. A log behind events of another
/// kind (two files, one after the other) does not count: it is met when they have been read.
[[nodiscard]] LogKind findKind(LogWindow& window);

/// Where to start reading so as to meet every event at or after `utimeUs`, by the block events from
/// the last one backwards; nothing where one of them is not intact or not in its place.
struct BlockPlace {
  std::uint64_t offset = 0, number = 0;
};
[[nodiscard]] std::optional<BlockPlace> findBlockOf(LogWindow& window, std::uint64_t logId,
                                                    std::int64_t utimeUs);

}  // namespace foretouch
