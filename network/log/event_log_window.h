// network/log/event_log_window.h: a window over the bytes of a log, wherever they are. Memory: one
// buffer of at most kMaxBlockSpan and a little, whatever the log says.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "network/log/event_log_format.h"

namespace foretouch {

/// Bytes that can be read from anywhere: a file's, or a test's own.
class LogBytes {
 public:
  virtual ~LogBytes() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Exactly `count` bytes from `offset` on; they lie within size().
  virtual Result<Done> read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) = 0;
};

/// Errors: not found, no regular file, not readable.
[[nodiscard]] Result<std::unique_ptr<LogBytes>> openLogFile(const std::string& path);
[[nodiscard]] std::unique_ptr<LogBytes> logInMemory(Bytes bytes);

/// An event as its header frames it.
struct Frame {
  std::uint64_t offset = 0;
  EventHeader header;
  [[nodiscard]] std::uint64_t end() const { return offset + header.eventBytes(); }
};

/// What stands at a place where an event may begin.
enum class FrameState : std::uint8_t {
  Whole,       ///< An event that fits.
  Torn,        ///< The end of the log comes first, and all that is there is as it should be.
  NoEvent,     ///< Other bytes.
  Impossible,  ///< The magic, and a header that cannot be.
};

/// A failed read ends every search as if nothing more was there; ask failure() afterwards.
class LogWindow {
 public:
  explicit LogWindow(std::unique_ptr<LogBytes> bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

  /// `count` bytes from `offset` on, valid until the next call of anything here; null where they
  /// do not all exist. Those from `keepFrom` on are kept for later if they are few.
  const std::uint8_t* view(std::uint64_t offset, std::size_t count, std::uint64_t keepFrom);
  const std::uint8_t* view(std::uint64_t offset, std::size_t count) {
    return view(offset, count, offset);
  }

  /// Where the magic next begins in [from, to), with all of it in the log; `to` where it does not.
  std::uint64_t findMagic(std::uint64_t from, std::uint64_t to);

  FrameState frameAt(std::uint64_t offset, Frame& frame, std::uint64_t keepFrom);
  FrameState frameAt(std::uint64_t offset, Frame& frame) { return frameAt(offset, frame, offset); }
  BlockEventState blockEventAt(std::uint64_t offset, BlockEvent& event, std::uint64_t keepFrom);
  BlockEventState blockEventAt(std::uint64_t offset, BlockEvent& event) {
    return blockEventAt(offset, event, offset);
  }
  /// Copies bytes from anywhere past the window, which stays as it is: for hops through a log.
  bool peek(std::uint64_t offset, std::uint8_t* bytes, std::size_t count);
  /// Whether the frame is on kLogBlockChannel.
  bool isOnBlockChannel(const Frame& frame, std::uint64_t keepFrom);
  /// The frame's event; false where reading failed.
  bool eventOf(const Frame& frame, LogEvent& event);

 private:
  bool load(std::uint64_t start, std::size_t count);

  std::unique_ptr<LogBytes> bytes_;
  std::uint64_t size_ = 0;
  std::optional<Error> failure_;
  Bytes buffer_;
  std::uint64_t bufferStart_ = 0;  ///< Offset of the buffer's first byte.
  std::size_t buffered_ = 0;       ///< Bytes of the buffer that are the log's.
};

}  // namespace foretouch
