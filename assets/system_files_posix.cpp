#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <climits>

#include "assets/system_files.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

FileState stateIn(const struct stat& status) {
  FileState state;
  state.bytes = static_cast<std::uint64_t>(status.st_size);
  state.permissions = status.st_mode & 0777;
  state.kind = FileKind::Other;
  if (S_ISREG(status.st_mode)) state.kind = FileKind::Regular;
  if (S_ISDIR(status.st_mode)) state.kind = FileKind::Folder;
  return state;
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

template <typename Call>
std::int64_t uninterrupted(const Call& call) {
  for (;;) {
    const std::int64_t done = call();
    if (done >= 0 || errno != EINTR) return done;
  }
}

/// The rename is on the disk only once the folder is. Not every file system can do this, and the
/// file is complete either way, so a failure is not an error.
void syncFolderOf(const std::string& target) {
  const int folder = ::open(folderOf(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  static_cast<void>(::fsync(folder));
  ::close(folder);
}

}  // namespace

FileState stateOf(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return stateIn(status);
  FileState state;
  state.kind = errno == ELOOP ? FileKind::RingOfLinks : FileKind::Missing;
  return state;
}

FileState stateOf(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? stateIn(status) : FileState();
}

int openToRead(const std::string& path) {
  // O_NONBLOCK: opening a pipe without a writer would wait for ever.
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

int openToWrite(const std::string& path) {
  return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
}

int openNew(const std::string& path, unsigned permissions) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
}

int openStandardOutput() {
  return ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
}

std::shared_ptr<const char> contentOf(int descriptor, std::uint64_t bytes) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || bytes == 0) return nullptr;
  const auto size = static_cast<std::size_t>(bytes);
  // What was checked must stay so: others could change the pages below our feet.
  const bool isOurs = (status.st_uid == ::geteuid() || status.st_uid == 0) &&
                      (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  void* const pages =
      isOurs ? ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0) : MAP_FAILED;
  if (pages != MAP_FAILED) {
    return {static_cast<const char*>(pages),
            [pages, size](const char* /*pages*/) { ::munmap(pages, size); }};
  }
  return copyOf(descriptor, size);
}

std::int64_t readSome(int descriptor, char* to, std::size_t most) {
  return uninterrupted([&] { return ::read(descriptor, to, most); });
}

std::int64_t writeSome(int descriptor, const char* from, std::size_t most) {
  return uninterrupted([&] { return ::write(descriptor, from, most); });
}

bool closeFile(int descriptor) {
  return ::close(descriptor) == 0;
}

bool syncFile(int descriptor) {
  return ::fsync(descriptor) == 0;
}

void setPermissions(int descriptor, unsigned permissions) {
  static_cast<void>(::fchmod(descriptor, permissions));
}

void removeFile(const std::string& path) {
  static_cast<void>(::unlink(path.c_str()));
}

bool replaceFile(const std::string& from, const std::string& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) return false;
  syncFolderOf(to);
  return true;
}

std::uint64_t processNumber() {
  return static_cast<std::uint64_t>(::getpid());
}

std::optional<std::string> withoutLinks(const std::string& given) {
  constexpr int kMostLinks = 40;  // as the kernel, which refuses one more
  std::string path = given;
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

}  // namespace foretouch::internal
