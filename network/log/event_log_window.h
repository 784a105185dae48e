// network/log/event_log_window.h: a window over the bytes of a log. Memory: one buffer of little
// more than kMaxBlockSpan, whatever the log contains.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "network/log/event_log_format.h"

namespace foretouch {

/// Bytes with random access: a file's, or a test's own.
class LogBytes {
 public:
  virtual ~LogBytes() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Exactly `count` bytes from `offset` on; they lie within size().
  virtual Result<Done> read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) = 0;
};

/// Errors: not found, not a regular file, not readable.
[[nodiscard]] Result<std::unique_ptr<LogBytes>> openLogFile(const std::string& path);

/// An event as its header frames it.
struct Frame {
  std::uint64_t offset = 0;
  EventHeader header;
  [[nodiscard]] std::uint64_t end() const { return offset + header.eventBytes(); }
};

/// What begins at an offset.
enum class FrameState : std::uint8_t {
  Whole,       ///< An event that fits.
  Torn,        ///< The log ends first; the part that is there is sound.
  NoEvent,     ///< Other bytes.
  Impossible,  ///< The magic, and an impossible header.
};

/// A failed read ends every search like the end of the log; check failure() afterwards.
class LogWindow {
 public:
  explicit LogWindow(std::unique_ptr<LogBytes> bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

  /// `count` bytes from `offset` on, valid until the next call on this object; null if they do not
  /// all exist. Keeps those from `keepFrom` on for later if they are few.
  const std::uint8_t* view(std::uint64_t offset, std::size_t count, std::uint64_t keepFrom);
  const std::uint8_t* view(std::uint64_t offset, std::size_t count) {
    return view(offset, count, offset);
  }

  /// Offset of the next whole magic that begins in [from, to); `to` if there is none.
  std::uint64_t findMagic(std::uint64_t from, std::uint64_t to);

  FrameState frameAt(std::uint64_t offset, Frame& frame, std::uint64_t keepFrom);
  FrameState frameAt(std::uint64_t offset, Frame& frame) { return frameAt(offset, frame, offset); }
  BlockEventState blockEventAt(std::uint64_t offset, BlockEvent& event, std::uint64_t keepFrom);
  BlockEventState blockEventAt(std::uint64_t offset, BlockEvent& event) {
    return blockEventAt(offset, event, offset);
  }
  /// Copies bytes from anywhere without moving the window: for hops through a log.
  bool peek(std::uint64_t offset, std::uint8_t* bytes, std::size_t count);
  /// Whether the frame is on kLogBlockChannel.
  bool isOnBlockChannel(const Frame& frame, std::uint64_t keepFrom);
  /// The frame's event; false if reading failed.
  bool eventOf(const Frame& frame, LogEvent& event);

 private:
  bool load(std::uint64_t start, std::size_t count);

  std::unique_ptr<LogBytes> bytes_;
  std::uint64_t size_ = 0;
  std::optional<Error> failure_;
  Bytes buffer_;
  std::uint64_t bufferStart_ = 0;  ///< Offset of the buffer's first byte.
  std::size_t buffered_ = 0;       ///< Valid bytes in the buffer.
};

}  // namespace foretouch
