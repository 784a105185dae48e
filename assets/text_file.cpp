#include "assets/text_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "assets/system_files.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {

using internal::FileKind;
using internal::FileState;

namespace {

constexpr std::size_t kChunkBytes = 1u << 20;

/// Reads to the end or past `limitBytes`: files in /proc state a size of zero, and others may grow
/// meanwhile.
Result<std::string> readAll(int descriptor, const std::string& path, std::size_t sizeHint,
                            std::size_t limitBytes) {
  std::string text;
  text.reserve(sizeHint);
  // One byte more than there is, to see the end at once.
  std::string chunk(std::min(kChunkBytes, sizeHint + 1), '\0');
  for (;;) {
    const std::int64_t got = internal::readSome(descriptor, chunk.data(), chunk.size());
    if (got < 0) {
      return Error::in(path, ErrorCode::FileUnreadable,
                       std::string("reading failed: ") + std::strerror(errno));
    }
    if (got == 0) return text;
    if (countOf(got) > limitBytes - text.size()) {
      return Error::in(path, ErrorCode::LimitExceeded,
                       "expected at most " + std::to_string(limitBytes) + " bytes, found more");
    }
    text.append(chunk, 0, countOf(got));
  }
}

struct Opened {
  std::string temporary;
  int descriptor = -1;
};

/// Never writes through a file or link planted under the name. The number makes the name unique
/// within this process, the process id among processes.
Opened openTemporary(const std::string& target, unsigned permissions) {
  static std::atomic<std::uint64_t> counter{0};
  constexpr int kAttempts = 64;  // only leftovers of earlier processes with our id collide
  Opened opened;
  for (int i = 0; i < kAttempts; ++i) {
    opened.temporary = target + ".part-" + std::to_string(internal::processNumber()) + "-" +
                       std::to_string(counter.fetch_add(1));
    opened.descriptor = internal::openNew(opened.temporary, permissions);
    if (opened.descriptor >= 0 || errno != EEXIST) break;
  }
  return opened;
}

}  // namespace

std::shared_ptr<const char> internal::copyOf(int descriptor, std::size_t bytes) {
  constexpr std::align_val_t kAlignment{64};
  if (bytes == 0) return nullptr;
  std::shared_ptr<char> copy(static_cast<char*>(::operator new(bytes, kAlignment, std::nothrow)),
                             [](char* memory) { ::operator delete(memory, kAlignment); });
  if (copy == nullptr) return nullptr;
  for (std::size_t have = 0; have < bytes;) {
    const std::int64_t got = readSome(descriptor, copy.get() + have, bytes - have);
    if (got <= 0) return nullptr;
    have += countOf(got);
  }
  return copy;
}

Result<std::string> readWholeFile(const std::string& path, std::size_t limitBytes) {
  const internal::FileDescriptor file(internal::openToRead(path));
  if (file.get() < 0 && internal::stateOf(path).kind == FileKind::Folder) {
    return Error::in(path, ErrorCode::FileUnreadable, "is not a regular file");
  }
  if (file.get() < 0) {
    return Error::in(path, ErrorCode::FileNotFound,
                     std::string("cannot be opened: ") + std::strerror(errno));
  }
  const FileState state = internal::stateOf(file.get());
  if (state.kind != FileKind::Regular) {
    return Error::in(path, ErrorCode::FileUnreadable, "is not a regular file");
  }
  if (state.bytes > limitBytes) {
    return Error::in(path, ErrorCode::LimitExceeded,
                     "expected at most " + std::to_string(limitBytes) + " bytes, found " +
                         std::to_string(state.bytes));
  }
  try {
    return readAll(file.get(), path, static_cast<std::size_t>(state.bytes), limitBytes);
  } catch (const std::bad_alloc&) {
    return Error::in(path, ErrorCode::LimitExceeded, "does not fit into memory");
  }
}

PendingFile::PendingFile(std::string path, std::string target, std::string temporary,
                         int descriptor)
    : path_(std::move(path)),
      target_(std::move(target)),
      temporary_(std::move(temporary)),
      descriptor_(descriptor) {}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      failure_(other.failure_),
      buffer_(std::move(other.buffer_)) {}

PendingFile::~PendingFile() {
  discard();
}

Result<PendingFile> PendingFile::create(const std::string& path) {
  const std::optional<std::string> followed = internal::withoutLinks(path);
  if (!followed) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     "is another user's link in a folder that all may write to; expected a file of "
                     "yours, or a new name");
  }
  const std::string& target = *followed;
  const FileState state = internal::stateOf(target);
  if (state.kind == FileKind::RingOfLinks) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     "is a ring of links, expected a file to write");
  }
  if (state.kind == FileKind::Folder) {
    return Error::in(path, ErrorCode::FileUnwritable, "is a folder, expected a file to write");
  }
  Opened opened;
  if (path == "/dev/stdout") {
    // Not the file behind it: a shell opened it, perhaps to append, and wants no other in its
    // place.
    opened.descriptor = internal::openStandardOutput();
  } else if (state.kind == FileKind::Other) {
    opened.descriptor = internal::openToWrite(target);
  } else {
    const bool isNew = state.kind == FileKind::Missing;
    opened = openTemporary(target, isNew ? 0666 : state.permissions);
    // The system took the umask off; a replaced file keeps its permissions.
    if (opened.descriptor >= 0 && !isNew) {
      internal::setPermissions(opened.descriptor, state.permissions);
    }
  }
  if (opened.descriptor < 0) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     std::string("cannot be written: ") + std::strerror(errno));
  }
  return PendingFile(path, target, opened.temporary, opened.descriptor);
}

void PendingFile::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kChunkBytes) flush();
}

void PendingFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty() && failure_ == 0) {
    const std::int64_t written = internal::writeSome(descriptor_, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(countOf(written));
    } else {
      failure_ = errno;
    }
  }
  buffer_.clear();
}

Result<Done> PendingFile::commit() {
  FORETOUCH_ASSERT(descriptor_ >= 0);  // once only
  flush();
  const bool inPlace = temporary_.empty();
  if (failure_ == 0 && !inPlace && !internal::syncFile(descriptor_)) failure_ = errno;
  if (!internal::closeFile(std::exchange(descriptor_, -1)) && failure_ == 0) failure_ = errno;
  if (failure_ == 0 && !inPlace) {
    if (internal::replaceFile(temporary_, target_)) {
      temporary_.clear();
    } else {
      failure_ = errno;
    }
  }
  discard();
  if (failure_ == 0) return Done{};
  return Error::in(path_, ErrorCode::FileUnwritable,
                   std::string("writing failed: ") + std::strerror(failure_));
}

void PendingFile::discard() noexcept {
  if (descriptor_ >= 0) static_cast<void>(internal::closeFile(std::exchange(descriptor_, -1)));
  if (!temporary_.empty()) internal::removeFile(temporary_);
  temporary_.clear();
}

}  // namespace foretouch
