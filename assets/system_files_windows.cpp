#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <share.h>
#include <sys/stat.h>
#include <windows.h>

#include <climits>

#include "assets/system_files.h"

namespace foretouch::internal {
namespace {

/// What is not UTF-8 becomes a name that no file has.
std::wstring wide(const std::string& text) {
  const auto convert = [&](wchar_t* to, int most) {
    return ::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), to, most);
  };
  std::wstring units(static_cast<std::size_t>(convert(nullptr, 0)), L'\0');
  static_cast<void>(convert(units.data(), static_cast<int>(units.size())));
  return units;
}

FileState stateIn(const struct _stat64& status) {
  FileState state;
  state.bytes = static_cast<std::uint64_t>(status.st_size);
  state.permissions = status.st_mode & (_S_IREAD | _S_IWRITE);
  state.kind = FileKind::Other;
  if ((status.st_mode & _S_IFMT) == _S_IFREG) state.kind = FileKind::Regular;
  if ((status.st_mode & _S_IFMT) == _S_IFDIR) state.kind = FileKind::Folder;
  return state;
}

int openedAs(const std::string& path, int flags, int permissions = 0) {
  return ::_wopen(wide(path).c_str(), flags | _O_BINARY | _O_NOINHERIT, permissions);
}

unsigned atMost(std::size_t bytes) {
  return static_cast<unsigned>(std::min<std::size_t>(bytes, INT_MAX));
}

}  // namespace

FileState stateOf(const std::string& path) {
  struct _stat64 status {};
  return ::_wstat64(wide(path).c_str(), &status) == 0 ? stateIn(status) : FileState();
}

FileState stateOf(int descriptor) {
  struct _stat64 status {};
  return ::_fstat64(descriptor, &status) == 0 ? stateIn(status) : FileState();
}

int openToRead(const std::string& path) {
  return openedAs(path, _O_RDONLY);
}

int openToWrite(const std::string& path) {
  return openedAs(path, _O_WRONLY);
}

int openNew(const std::string& path, unsigned permissions) {
  // This call knows no permissions of groups and others.
  return openedAs(path, _O_WRONLY | _O_CREAT | _O_EXCL,
                  static_cast<int>(permissions) & (_S_IREAD | _S_IWRITE));
}

int openStandardOutput() {
  return ::_dup(1);
}

std::shared_ptr<const char> contentOf(int descriptor, std::uint64_t bytes) {
  return copyOf(descriptor, static_cast<std::size_t>(bytes));
}

std::int64_t readSome(int descriptor, char* to, std::size_t most) {
  return ::_read(descriptor, to, atMost(most));
}

std::int64_t writeSome(int descriptor, const char* from, std::size_t most) {
  return ::_write(descriptor, from, atMost(most));
}

bool closeFile(int descriptor) {
  return ::_close(descriptor) == 0;
}

bool syncFile(int descriptor) {
  return ::_commit(descriptor) == 0;
}

void setPermissions(int /* descriptor */, unsigned /* permissions */) {}

void removeFile(const std::string& path) {
  static_cast<void>(::_wunlink(wide(path).c_str()));
}

bool replaceFile(const std::string& from, const std::string& to) {
  constexpr DWORD kHow = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
  if (::MoveFileExW(wide(from).c_str(), wide(to).c_str(), kHow) != 0) return true;
  errno = EACCES;
  return false;
}

std::uint64_t processNumber() {
  return static_cast<std::uint64_t>(::_getpid());
}

/// A user who may make links there is also trusted with the files of others.
std::optional<std::string> withoutLinks(const std::string& path) {
  return path;
}

}  // namespace foretouch::internal
