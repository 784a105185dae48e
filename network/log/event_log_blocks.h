// network/log/event_log_blocks.h: the events of a log with check sums, block by block; and those of
// one without, by their framing.
#pragma once

#include <cstdint>
#include <optional>

#include "network/log/event_log_window.h"

namespace foretouch {

/// Returns a block's events once its hash has proved right, and no others.
///
/// There are two ways to find a block. First by framing, from the end of the last block on, which
/// is enough in a sound log. If that does not end at a block event whose block begins there, then
/// by searching the same bytes for the next intact block event of this log. So a wrong length,
/// garbage or a lost block event costs only its own block. The log's id is in every block event, so
/// the reader never mistakes bytes of another log inside a payload for this one's.
class CheckedBlocks {
 public:
  CheckedBlocks(LogWindow& window, LogCounts& counts, const LogReadOptions& options)
      : window_(window), counts_(counts), options_(options) {}

  /// Starts at `offset`, where block `number` of this log should begin. Without an id it accepts
  /// only a tail.
  void start(std::uint64_t offset, std::optional<std::uint64_t> logId, std::uint64_t number = 0);

  /// False at the end.
  bool next(LogEvent& event);
  [[nodiscard]] std::uint64_t position() const;

 private:
  /// Moves to the next block with events in it.
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
  std::uint64_t next_ = 0;      ///< Offset of the next block.
  /// Total bytes that framing may still visit beyond `next_`: stops a crafted log from making it
  /// scan the same bytes again and again.
  std::uint64_t walkCredit_ = 0;
  bool isTail_ = false;
  std::uint64_t cursor_ = 0, end_ = 0;  ///< The rest of the current block, or of the tail.
};

/// An event of a log without check sums, and the damage skipped to find it.
struct FoundFrame {
  Frame frame;
  bool isFound = false;
  std::uint64_t impossible = 0;  ///< Headers with impossible lengths.
  bool isTorn = false;           ///< Not found; the log ends within an event.
};

/// The first event at or after `offset` that begins before `limit`. An event whose end is not the
/// start of another counts only if no event inside it fits better: otherwise its length is the
/// damage.
[[nodiscard]] FoundFrame findFrame(LogWindow& window, std::uint64_t offset, std::uint64_t limit);

/// The kind of a log, which decides how to read it.
struct LogKind {
  bool isEmpty = false;  ///< Not a single event.
  bool hasCheckSums = false;
  std::optional<std::uint64_t> logId;
};

/// From the events that begin within kMaxBlockSpan of the first one: our logs have an intact block
/// event among them, at the very start if undamaged. A log behind events of another kind (two
/// files, one after the other) does not count; the reader meets it after them.
[[nodiscard]] LogKind findKind(LogWindow& window);

}  // namespace foretouch
