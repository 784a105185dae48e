// assets/import/stream.h: the frames in which foretouch-import answers its parent, for scenes and
// models. Not installed.
//
// A greeting (magic, version, byte order), then frames: type and payload size as 32-bit numbers,
// then the payload. One of them, at any place or none, says what frame the file declares and what
// the child made of it. Last a trailer with a count and a checksum of everything before it. Or, at
// any place before the trailer, a failure with its text. Native byte order: both ends are processes
// of one machine. The checksum detects a stream that something else wrote into. Against everything
// else, the readers trust nothing in the stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

#include "assets/file_frame.h"

namespace foretouch::internal {

inline constexpr std::size_t kMaxImportFrameBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxImportNameBytes = std::size_t{64} << 20;  // all names together
inline constexpr std::size_t kMaxFailureTextBytes = 1024;

enum class ImportFailure : std::uint32_t {
  None,
  Refused,        ///< The file breaks its format's rules.
  UnknownFormat,  ///< No reader for the file's extension.
  TooLarge,       ///< Exceeds a limit.
  OutOfMemory,
};

/// Types below 16 belong to scenes (assets/import/protocol.cpp), the others to models
/// (assets/import/model_records.h).
inline constexpr std::uint32_t kTrailerFrame = 4, kFailureFrame = 5, kFileFrame = 6;

template <typename T>
std::string_view bytesOf(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// The value at the start of `bytes`, which must be long enough.
template <typename T>
T valueIn(std::string_view bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// The child's end, without the meaning of the frames.
class FrameWriter {
 public:
  /// Takes bytes; false if that failed for good.
  using Sink = std::function<bool(std::string_view)>;
  explicit FrameWriter(Sink sink);

  bool fail(ImportFailure failure, std::string_view text);
  /// What the numbers that are sent were read with.
  void fileFrame(const FileFrame& fileFrame);

 protected:
  void frame(std::uint32_t type, std::string_view payload);
  /// False if any byte could not be sent.
  bool end(std::uint64_t count);

 private:
  void put(std::string_view bytes);
  void flush();

  Sink sink_;
  bool intact_ = true;
  std::uint64_t checksum_;
  std::string outgoing_;  // buffered frames: many are small
};

/// The parent's end: an incremental parser that trusts no byte.
class FrameReader {
 public:
  enum class State : std::uint8_t {
    Reading,
    Complete,  ///< The trailer arrived and agrees.
    Failed,    ///< The child reported failure() and failureText().
    Broken,    ///< The bytes break the protocol: broken() says how.
  };
  virtual ~FrameReader() = default;

  /// Ignores bytes after any state but Reading.
  State feed(std::string_view bytes);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool greeted() const { return greeted_; }
  [[nodiscard]] ImportFailure failure() const { return failure_; }
  [[nodiscard]] const std::string& failureText() const { return failureText_; }
  [[nodiscard]] const std::string& broken() const { return broken_; }
  /// What the numbers were read with: nothing declared unless the child says so.
  [[nodiscard]] const FileFrame& fileFrame() const { return fileFrame_; }

 protected:
  /// Any frame but a failure, the file's frame and the trailer.
  virtual void parseFrame(std::uint32_t type, std::string_view payload) = 0;
  /// Has everything promised arrived, `count` of it?
  [[nodiscard]] virtual bool isWhole(std::uint64_t count) const = 0;
  void breakOff(std::string reason);

 private:
  std::size_t parseOne(std::string_view bytes);
  std::size_t parseGreeting(std::string_view bytes);
  void parseFailure(std::string_view payload);
  void parseFileFrame(std::string_view payload);
  void parseTrailer(std::string_view payload);

  State state_ = State::Reading;
  bool greeted_ = false;
  std::uint64_t checksum_ = 0;
  ImportFailure failure_ = ImportFailure::None;
  std::string failureText_, broken_;
  FileFrame fileFrame_;
  std::string pending_;  // the incomplete frame at the end
};

}  // namespace foretouch::internal
