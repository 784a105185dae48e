#include "tools/batch/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

constexpr char kScratchLead[] = ".work-";
constexpr char kLockName[] = "/lock";

/// False if another worker holds it, or the folder is gone.
bool isLocked(int lock, const std::string& path) {
  struct stat held {
  }, there{};
  return ::flock(lock, LOCK_EX | LOCK_NB) == 0 && ::fstat(lock, &held) == 0 &&
         ::stat(path.c_str(), &there) == 0 && held.st_ino == there.st_ino;
}

/// Removes the folders of workers that are gone. Where the file system has no locks, they stay.
void removeLeftovers(const std::string& results) {
  std::error_code failure;
  for (fs::directory_iterator entry(results, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string path = entry->path().string();
    if (entry->path().filename().string().rfind(kScratchLead, 0) != 0) continue;
    const std::string lockPath = path + kLockName;
    const int lock = ::open(lockPath.c_str(), O_RDWR | O_CLOEXEC);
    if (lock < 0) continue;
    std::error_code unremoved;
    if (isLocked(lock, lockPath)) fs::remove_all(path, unremoved);
    ::close(lock);
  }
}

}  // namespace

Result<ScratchFolder> ScratchFolder::create(const std::string& results) {
  removeLeftovers(results);
  constexpr int kAttempts = 8;  // another worker may take a new folder for a leftover
  for (int i = 0; i < kAttempts; ++i) {
    std::string path = results + "/" + kScratchLead + "XXXXXX";
    if (::mkdtemp(path.data()) == nullptr) break;
    const std::string lockPath = path + kLockName;
    const int lock = ::open(lockPath.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (lock < 0) {
      ::rmdir(path.c_str());
      break;
    }
    const bool hasNoLocks = ::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno != EWOULDBLOCK;
    if (hasNoLocks || isLocked(lock, lockPath)) return ScratchFolder(std::move(path), lock);
    ::close(lock);
  }
  return Error::in(results, ErrorCode::FileUnwritable,
                   std::string("no folder could be made in it: ") + std::strerror(errno));
}

ScratchFolder::ScratchFolder(ScratchFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

ScratchFolder::~ScratchFolder() {
  if (path_.empty()) return;
  std::error_code unremoved;
  fs::remove_all(path_, unremoved);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace foretouch::tools
