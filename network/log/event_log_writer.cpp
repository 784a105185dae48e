#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <optional>
#include <sys/random.h>
#include <unistd.h>
#include <utility>

#include "lss/index.h"
#include "network/log/event_log_format.h"

namespace foretouch {
namespace {

std::uint64_t drawLogId() {
  std::uint64_t id = 0;
  if (::getrandom(&id, sizeof id, GRND_NONBLOCK) == static_cast<ssize_t>(sizeof id)) return id;
  // No entropy yet (an early boot): unlikely to repeat is enough, only a forger would profit.
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const auto words = {static_cast<std::uint64_t>(now.tv_sec),
                      static_cast<std::uint64_t>(now.tv_nsec),
                      static_cast<std::uint64_t>(::getpid())};
  Bytes bytes;
  for (const std::uint64_t word : words) {
    for (int shift = 0; shift < 64; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(word >> shift));
  }
  return blockHashOf(bytes, 0);
}

/// Whether `later` is at least `gap` after `earlier`, or before it; no stamp overflows.
bool isApart(std::int64_t earlier, std::int64_t later, std::int64_t gap) {
  return later < earlier ||
         static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier) >=
             static_cast<std::uint64_t>(std::max<std::int64_t>(gap, 0));
}

}  // namespace

struct EventLogWriter::Impl {
  Impl(std::string filePath, int descriptor, const LogWriteOptions& writeOptions)
      : path(std::move(filePath)), file(descriptor), options(writeOptions) {
    check.logId = drawLogId();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (file < 0) return;
    static_cast<void>(close());
    if (file >= 0) ::close(file);
  }

  [[nodiscard]] Error failed(ErrorCode code, std::string why) const {
    return Error::in(path, code, std::move(why));
  }
  [[nodiscard]] Error unwritable(const char* what) const {
    return failed(ErrorCode::FileUnwritable, std::string(what) + ": " + std::strerror(errno));
  }

  Result<Done> checkEvent(const std::string& channel, ByteView payload) const;
  Result<Done> append(const Bytes& bytes);
  Result<Done> writeAll(const Bytes& bytes);
  Result<Done> closeBlock(bool isLast);
  Result<Done> write(std::int64_t utimeUs, const std::string& channel, ByteView payload);
  Result<Done> close();

  std::string path;
  int file;
  LogWriteOptions options;
  std::uint64_t good = 0;   ///< Bytes of the file that are sound.
  bool hasRemains = false;  ///< Bytes of a failed write after them, still to cut off.
  Bytes block;              ///< Events that are not in the file yet.
  BlockEvent check;         ///< This block's, as it grows.
  std::int64_t firstUs = 0;
};

Result<Done> EventLogWriter::Impl::checkEvent(const std::string& channel, ByteView payload) const {
  if (file < 0) return failed(ErrorCode::FileUnwritable, "the log is closed");
  if (channel == kLogBlockChannel) {
    return failed(ErrorCode::OutOfRange, "channel '" + channel + "' is the log's own");
  }
  if (!isLogChannel(channel)) {
    return failed(ErrorCode::OutOfRange, "expected a channel of 1 to " +
                                             std::to_string(kMaxLogChannelBytes) +
                                             " bytes without control characters");
  }
  if (payload.size > kMaxLogPayloadBytes) {
    return failed(ErrorCode::LimitExceeded, "a payload of " + std::to_string(payload.size) +
                                                " bytes on '" + channel + "', expected at most " +
                                                std::to_string(kMaxLogPayloadBytes));
  }
  return Done{};
}

/// Appends all of the bytes to the file, or none of them.
Result<Done> EventLogWriter::Impl::append(const Bytes& bytes) {
  if (hasRemains && ::ftruncate(file, static_cast<off_t>(good)) != 0) {
    return unwritable("cannot be cut back to its last whole block");
  }
  hasRemains = true;
  auto written = writeAll(bytes);
  if (written.ok()) {
    good += bytes.size();
    hasRemains = false;
  } else if (::ftruncate(file, static_cast<off_t>(good)) == 0) {
    hasRemains = false;
  }
  return written;
}

Result<Done> EventLogWriter::Impl::writeAll(const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count =
        ::pwrite(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(good + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return unwritable("cannot be written");
    done += countOf(count);
  }
  if (options.syncBlocks && ::fdatasync(file) != 0) return unwritable("cannot be synced");
  return Done{};
}

Result<Done> EventLogWriter::Impl::closeBlock(bool isLast) {
  const std::size_t eventBytes = block.size();
  check.isLast = isLast;
  check.offset = good + eventBytes;
  check.blockBytes = eventBytes;
  check.blockHash = blockHashOf(block, check.logId);
  appendBlockEvent(block, check);
  const auto written = append(block);
  if (!written.ok()) {
    block.resize(eventBytes);
    return written;
  }
  block.clear();
  check.firstNumber += static_cast<std::int64_t>(check.blockEvents);
  check.previous = check.offset;
  check.blockEvents = 0;
  ++check.number;
  return Done{};
}

Result<Done> EventLogWriter::Impl::write(std::int64_t utimeUs, const std::string& channel,
                                         ByteView payload) {
  const auto legal = checkEvent(channel, payload);
  if (!legal.ok()) return legal;
  if (check.number == 0) {
    // Opens the log. Its stamp is the first event's, so that a player does not wait between them.
    check.utimeUs = check.earliestUs = check.latestUs = utimeUs;
    const auto opened = closeBlock(false);
    if (!opened.ok()) return opened;
  }
  const std::size_t bytes = kEventHeaderBytes + channel.size() + payload.size;
  const bool isFull = block.size() + bytes > options.blockBytes;
  if (!block.empty() && (isFull || isApart(firstUs, utimeUs, options.blockUs))) {
    const auto closed = closeBlock(false);
    if (!closed.ok()) return closed;
  }
  const BlockEvent before = check;
  const std::size_t sizeBefore = block.size();
  if (block.empty()) firstUs = check.earliestUs = check.latestUs = utimeUs;
  appendEvent(block, check.firstNumber + static_cast<std::int64_t>(check.blockEvents), utimeUs,
              channel, payload);
  ++check.blockEvents;
  check.utimeUs = utimeUs;
  check.earliestUs = std::min(check.earliestUs, utimeUs);
  check.latestUs = std::max(check.latestUs, utimeUs);
  if (block.size() < options.blockBytes) return Done{};
  auto closed = closeBlock(false);
  if (!closed.ok()) {
    block.resize(sizeBefore);
    check = before;
  }
  return closed;
}

Result<Done> EventLogWriter::Impl::close() {
  if (file < 0) return Done{};
  const auto closed = closeBlock(true);
  if (!closed.ok()) return closed;
  const bool isClosed = ::close(std::exchange(file, -1)) == 0;
  if (!isClosed) return unwritable("cannot be closed");
  return Done{};
}

EventLogWriter::EventLogWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EventLogWriter::EventLogWriter(EventLogWriter&&) noexcept = default;
EventLogWriter& EventLogWriter::operator=(EventLogWriter&&) noexcept = default;
EventLogWriter::~EventLogWriter() = default;

Result<EventLogWriter> EventLogWriter::create(const std::string& path,
                                              const LogWriteOptions& options) {
  Error error;
  error.file = path;
  if (options.blockBytes < 1 || options.blockBytes > kMaxLogBlockBytes) {
    error.code = ErrorCode::OutOfRange;
    error.message = "blocks of " + std::to_string(options.blockBytes) + " bytes, expected 1 to " +
                    std::to_string(kMaxLogBlockBytes);
    return error;
  }
  constexpr int kOwnersAlone = 0600;  // how a person moves is that person's affair
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnersAlone);
  if (file < 0) {
    error.code = ErrorCode::FileUnwritable;
    error.message = errno == EEXIST ? "exists already: a log is never written over another file"
                                    : std::string("cannot be made: ") + std::strerror(errno);
    return error;
  }
  return EventLogWriter(std::make_unique<Impl>(path, file, options));
}

Result<Done> EventLogWriter::write(std::int64_t utimeUs, const std::string& channel,
                                   ByteView payload) {
  return impl_->write(utimeUs, channel, payload);
}

Result<Done> EventLogWriter::flush() {
  if (impl_->file < 0 || impl_->block.empty()) return Done{};
  return impl_->closeBlock(false);
}

Result<Done> EventLogWriter::close() {
  return impl_->close();
}

}  // namespace foretouch
