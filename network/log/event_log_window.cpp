#include "network/log/event_log_window.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "lss/index.h"

namespace foretouch {
namespace {

/// Bytes to read at once if fewer are needed.
constexpr std::size_t kReadBytes = 256u << 10;
/// The buffer keeps up to this many bytes already passed, so that a block's events are still there
/// when its check sum comes.
constexpr std::uint64_t kKeptBytes = 1u << 20;

std::string_view asText(const std::uint8_t* bytes, std::size_t count) {
  return {reinterpret_cast<const char*>(bytes), count};
}

class FileBytes : public LogBytes {
 public:
  FileBytes(std::string path, int file, std::uint64_t size)
      : path_(std::move(path)), file_(file), size_(size) {}
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes() override { ::close(file_); }

  [[nodiscard]] std::uint64_t size() const override { return size_; }

  Result<Done> read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) override {
    while (count > 0) {
      const ssize_t got = ::pread(file_, bytes, count, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return failed(std::string("cannot be read: ") + std::strerror(errno));
      if (got == 0) return failed("became shorter while it was read");
      bytes += got;
      offset += static_cast<std::uint64_t>(got);
      count -= countOf(got);
    }
    return Done{};
  }

 private:
  [[nodiscard]] Error failed(const std::string& why) const {
    return Error::in(path_, ErrorCode::FileUnreadable, why);
  }

  std::string path_;
  int file_;
  std::uint64_t size_;
};

}  // namespace

Result<std::unique_ptr<LogBytes>> openLogFile(const std::string& path) {
  Error error;
  error.file = path;
  // Not blocking: a FIFO without a writer would never open.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    error.code = errno == ENOENT ? ErrorCode::FileNotFound : ErrorCode::FileUnreadable;
    error.message = std::string("cannot be opened: ") + std::strerror(errno);
    return error;
  }
  struct stat status {};
  const bool isKnown = ::fstat(file, &status) == 0;
  if (!isKnown || !S_ISREG(status.st_mode)) {
    error.code = ErrorCode::FileUnreadable;
    error.message = isKnown ? "expected a regular file"
                            : std::string("cannot be read: ") + std::strerror(errno);
    ::close(file);
    return error;
  }
  return std::unique_ptr<LogBytes>(
      std::make_unique<FileBytes>(path, file, static_cast<std::uint64_t>(status.st_size)));
}

LogWindow::LogWindow(std::unique_ptr<LogBytes> bytes)
    : bytes_(std::move(bytes)), size_(bytes_->size()) {}

bool LogWindow::load(std::uint64_t start, std::size_t count) {
  const auto wanted =
      static_cast<std::size_t>(std::min<std::uint64_t>(size_ - start, std::max(count, kReadBytes)));
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  std::size_t kept = 0;
  if (start >= bufferStart_ && start < bufferStart_ + buffered_) {
    const auto skipped = static_cast<std::size_t>(start - bufferStart_);
    kept = std::min(buffered_ - skipped, wanted);
    std::memmove(buffer_.data(), buffer_.data() + skipped, kept);
  }
  bufferStart_ = start;
  buffered_ = kept;
  const auto read = bytes_->read(start + kept, buffer_.data() + kept, wanted - kept);
  if (!read.ok()) {
    failure_ = read.error();
    return false;
  }
  buffered_ = wanted;
  return true;
}

const std::uint8_t* LogWindow::view(std::uint64_t offset, std::size_t count,
                                    std::uint64_t keepFrom) {
  if (failure_ || offset > size_ || count > size_ - offset) return nullptr;
  const std::uint64_t end = offset + count;
  if (offset < bufferStart_ || end > bufferStart_ + buffered_) {
    const bool keeps = keepFrom <= offset && end - keepFrom <= kKeptBytes;
    const std::uint64_t start = keeps ? keepFrom : offset;
    if (!load(start, static_cast<std::size_t>(end - start) + (keeps ? kReadBytes : 0))) {
      return nullptr;
    }
  }
  return buffer_.data() + (offset - bufferStart_);
}

std::uint64_t LogWindow::findMagic(std::uint64_t from, std::uint64_t to) {
  constexpr std::uint64_t kMagicBytes = sizeof kEventMagic;
  const std::uint64_t end = std::min(to + (kMagicBytes - 1), size_);
  while (from < to && from + kMagicBytes <= end) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(end - from, kReadBytes));
    const std::uint8_t* const bytes = view(from, count);
    if (bytes == nullptr) return to;
    const std::size_t found = asText(bytes, count).find(asText(kEventMagic, kMagicBytes));
    if (found != std::string_view::npos) return from + found;
    from += count - (kMagicBytes - 1);
  }
  return to;
}

FrameState LogWindow::frameAt(std::uint64_t offset, Frame& frame, std::uint64_t keepFrom) {
  frame.offset = offset;
  const std::uint64_t left = size_ - std::min(size_, offset);
  if (left < kEventHeaderBytes) {
    const auto magic = static_cast<std::size_t>(std::min<std::uint64_t>(left, sizeof kEventMagic));
    const std::uint8_t* const bytes = view(offset, magic, keepFrom);
    const bool isStart =
        left > 0 && bytes != nullptr && std::memcmp(bytes, kEventMagic, magic) == 0;
    return isStart ? FrameState::Torn : FrameState::NoEvent;
  }
  const std::uint8_t* bytes = view(offset, kEventHeaderBytes, keepFrom);
  if (bytes == nullptr || std::memcmp(bytes, kEventMagic, sizeof kEventMagic) != 0) {
    return FrameState::NoEvent;
  }
  if (!parseEventHeader(bytes, frame.header)) return FrameState::Impossible;
  const auto channelBytes = static_cast<std::size_t>(
      std::min<std::uint64_t>(frame.header.channelBytes, left - kEventHeaderBytes));
  bytes = view(offset, kEventHeaderBytes + channelBytes, keepFrom);
  if (bytes == nullptr) return FrameState::NoEvent;
  const std::string_view channel = asText(bytes + kEventHeaderBytes, channelBytes);
  if (!channel.empty() && !isLogChannel(channel)) return FrameState::Impossible;
  return frame.header.eventBytes() <= left ? FrameState::Whole : FrameState::Torn;
}

BlockEventState LogWindow::blockEventAt(std::uint64_t offset, BlockEvent& event,
                                        std::uint64_t keepFrom) {
  const std::uint8_t* const bytes = view(offset, kBlockEventBytes, keepFrom);
  return bytes == nullptr ? BlockEventState::None : parseBlockEvent(bytes, event);
}

bool LogWindow::peek(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) {
  if (failure_ || offset > size_ || count > size_ - offset) return false;
  if (offset >= bufferStart_ && offset + count <= bufferStart_ + buffered_) {
    std::memcpy(bytes, buffer_.data() + (offset - bufferStart_), count);
    return true;
  }
  const auto read = bytes_->read(offset, bytes, count);
  if (!read.ok()) failure_ = read.error();
  return read.ok();
}

bool LogWindow::isOnBlockChannel(const Frame& frame, std::uint64_t keepFrom) {
  constexpr std::size_t kBlockChannelBytes = sizeof kLogBlockChannel - 1;
  if (frame.header.channelBytes != kBlockChannelBytes) return false;
  const std::uint8_t* const bytes =
      view(frame.offset, kEventHeaderBytes + kBlockChannelBytes, keepFrom);
  return bytes != nullptr &&
         std::memcmp(bytes + kEventHeaderBytes, kLogBlockChannel, kBlockChannelBytes) == 0;
}

bool LogWindow::eventOf(const Frame& frame, LogEvent& event) {
  const std::uint8_t* const bytes = view(frame.offset, frame.header.eventBytes());
  if (bytes == nullptr) return false;
  const std::uint8_t* const channel = bytes + kEventHeaderBytes;
  const std::uint8_t* const payload = channel + frame.header.channelBytes;
  event.number = frame.header.number;
  event.utimeUs = frame.header.utimeUs;
  event.channel = asText(channel, frame.header.channelBytes);
  event.payload.assign(payload, payload + frame.header.payloadBytes);
  return true;
}

}  // namespace foretouch
