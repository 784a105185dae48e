#include "assets/text_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <climits>

#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {
namespace {

constexpr std::size_t kChunkBytes = 1u << 20;

/// Closes on every path; PendingFile needs the result of close(), so it has its own.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Reads to the end or past `limitBytes`: files in /proc state a size of zero, and others may grow
/// meanwhile.
Result<std::string> readAll(int descriptor, const std::string& path, std::size_t sizeHint,
                            std::size_t limitBytes) {
  std::string text;
  text.reserve(sizeHint);
  // One byte more than there is, to see the end at once.
  std::string chunk(std::min(kChunkBytes, sizeHint + 1), '\0');
  for (;;) {
    const ssize_t got = ::read(descriptor, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
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

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "./" : path.substr(0, slash + 1);
}

/// In a folder that everybody may write to, such as /tmp, a link of somebody else is a trap: it
/// leads to a file of ours. open() refuses to follow it where fs.protected_symlinks is set, but
/// only as a path's last name; reading the link, as we must, is always allowed.
bool isOfAStranger(const struct stat& link, const std::string& path) {
  struct stat folder {};
  if (::stat(folderOf(path).c_str(), &folder) != 0) return true;
  const bool isShared = (folder.st_mode & S_IWOTH) != 0 && (folder.st_mode & S_ISVTX) != 0;
  return isShared && link.st_uid != ::geteuid() && link.st_uid != folder.st_uid;
}

/// Where the link `path` leads; nothing if its text does not say: those of /proc lead to pipes and
/// to files without a name.
std::optional<std::string> targetOf(const std::string& path) {
  std::string text(PATH_MAX, '\0');
  const ssize_t length = ::readlink(path.c_str(), text.data(), text.size());
  if (length <= 0) return std::nullopt;
  text.resize(countOf(length));
  const std::string target = text.front() == '/' ? text : folderOf(path) + text;
  struct stat unused {};
  const bool isThere = ::stat(path.c_str(), &unused) == 0;
  return isThere && ::lstat(target.c_str(), &unused) != 0 ? std::nullopt : std::optional(target);
}

/// The path without links, as far as there is one yet. Nothing if one of them, on the way or at the
/// end, is another user's trap.
std::optional<std::string> resolved(std::string path) {
  constexpr int kMostLinks = 40;  // as the kernel, which refuses one more
  int links = 0;
  for (std::size_t end = 0; end < path.size();) {
    end = std::min(path.find('/', end + 1), path.size());
    const std::string upTo = path.substr(0, end);
    struct stat status {};
    if (::lstat(upTo.c_str(), &status) != 0) break;
    if (!S_ISLNK(status.st_mode)) continue;
    if (isOfAStranger(status, upTo)) return std::nullopt;
    const auto target = targetOf(upTo);
    if (!target || ++links > kMostLinks) break;
    path = *target + path.substr(end);
    end = 0;
  }
  return path;
}

struct Opened {
  std::string temporary;
  int descriptor = -1;
};

/// O_EXCL: never writes through a file or link planted under the name. The number makes the name
/// unique within this process, the process id among processes.
Opened openTemporary(const std::string& target, mode_t mode) {
  static std::atomic<std::uint64_t> counter{0};
  constexpr int kAttempts = 64;  // only leftovers of earlier processes with our id collide
  Opened opened;
  for (int i = 0; i < kAttempts; ++i) {
    opened.temporary =
        target + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1));
    opened.descriptor =
        ::open(opened.temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (opened.descriptor >= 0 || errno != EEXIST) break;
  }
  return opened;
}

/// The rename is on the disk only once the folder is. Not every file system can do this, and the
/// file is complete either way, so a failure is not an error.
void syncFolderOf(const std::string& target) {
  const Descriptor descriptor(::open(folderOf(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) static_cast<void>(::fsync(descriptor.get()));
}

}  // namespace

Result<std::string> readWholeFile(const std::string& path, std::size_t limitBytes) {
  // O_NONBLOCK: opening a pipe without a writer would wait for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    return Error::in(path, ErrorCode::FileNotFound,
                     std::string("cannot be opened: ") + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return Error::in(path, ErrorCode::FileUnreadable, "is not a regular file");
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > limitBytes) {
    return Error::in(
        path, ErrorCode::LimitExceeded,
        "expected at most " + std::to_string(limitBytes) + " bytes, found " + std::to_string(size));
  }
  try {
    return readAll(file.get(), path, static_cast<std::size_t>(size), limitBytes);
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
  const std::optional<std::string> followed = resolved(path);
  if (!followed) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     "is another user's link in a folder that all may write to; expected a file of "
                     "yours, or a new name");
  }
  const std::string& target = *followed;
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (!exists && errno == ELOOP) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     "is a ring of links, expected a file to write");
  }
  if (exists && S_ISDIR(status.st_mode)) {
    return Error::in(path, ErrorCode::FileUnwritable, "is a folder, expected a file to write");
  }
  Opened opened;
  if (path == "/dev/stdout") {
    // Not the file behind it: a shell opened it, perhaps to append, and wants no other in its
    // place.
    opened.descriptor = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  } else if (exists && !S_ISREG(status.st_mode)) {
    opened.descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    opened = openTemporary(target, exists ? status.st_mode & 0777 : 0666);
  }
  // open() applied the umask to the mode; a replaced file keeps its mode.
  if (opened.descriptor >= 0 && exists && !opened.temporary.empty()) {
    static_cast<void>(::fchmod(opened.descriptor, status.st_mode & 0777));
  }
  if (opened.descriptor < 0) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     std::string("cannot be written: ") + std::strerror(errno));
  }
  return PendingFile(path, target, opened.temporary, opened.descriptor);
}

void PendingFile::write(const std::string& text) {
  buffer_ += text;
  if (buffer_.size() >= kChunkBytes) flush();
}

void PendingFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty() && failure_ == 0) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(countOf(written));
    } else if (errno != EINTR) {
      failure_ = errno;
    }
  }
  buffer_.clear();
}

Result<Done> PendingFile::commit() {
  FORETOUCH_ASSERT(descriptor_ >= 0);  // once only
  flush();
  const bool inPlace = temporary_.empty();
  if (failure_ == 0 && !inPlace && ::fsync(descriptor_) != 0) failure_ = errno;
  if (::close(std::exchange(descriptor_, -1)) != 0 && failure_ == 0) failure_ = errno;
  if (failure_ == 0 && !inPlace) {
    if (::rename(temporary_.c_str(), target_.c_str()) == 0) {
      temporary_.clear();
      syncFolderOf(target_);
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
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

}  // namespace foretouch
