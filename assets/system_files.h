// assets/system_files.h: what text_file.h asks of the system, for which each system has its own way
// (system_files_posix.cpp, system_files_windows.cpp). Paths are UTF-8. Failures are those of errno.
// Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace foretouch::internal {

enum class FileKind : std::uint8_t { Missing, Regular, Folder, Other, RingOfLinks };

struct FileState {
  FileKind kind = FileKind::Missing;
  std::uint64_t bytes = 0;
  unsigned permissions = 0;
};

/// The state of what the path leads to, through links.
[[nodiscard]] FileState stateOf(const std::string& path);
[[nodiscard]] FileState stateOf(int descriptor);

/// Descriptors, below zero on failure. None waits for the other end of a pipe to be read from, or
/// is passed on to programs that are started.
[[nodiscard]] int openToRead(const std::string& path);
[[nodiscard]] int openToWrite(const std::string& path);
/// Only where nothing has that name, be it a link.
[[nodiscard]] int openNew(const std::string& path, unsigned permissions);
[[nodiscard]] int openStandardOutput();

/// The first `bytes` of a file: its pages, which all its readers share, where the system has such;
/// else a copy. Nothing if there are fewer, or no memory. Pages change with the file: code that
/// makes one anew must replace it, as PendingFile does.
[[nodiscard]] std::shared_ptr<const char> contentOf(int descriptor, std::uint64_t bytes);

/// The copy. Aligned for what vectors load.
[[nodiscard]] std::shared_ptr<const char> copyOf(int descriptor, std::size_t bytes);

/// How many bytes, below zero on failure. An interrupted call begins anew.
[[nodiscard]] std::int64_t readSome(int descriptor, char* to, std::size_t most);
[[nodiscard]] std::int64_t writeSome(int descriptor, const char* from, std::size_t most);
[[nodiscard]] bool closeFile(int descriptor);
/// On the disk, not only on its way there.
[[nodiscard]] bool syncFile(int descriptor);
/// Owns a descriptor: closes it on every path. A caller that needs the result closes it itself.
class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor = -1) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileDescriptor() { close(); }
  void close() {
    if (descriptor_ >= 0) static_cast<void>(closeFile(std::exchange(descriptor_, -1)));
  }
  [[nodiscard]] int get() const { return descriptor_; }
  [[nodiscard]] bool isOpen() const { return descriptor_ >= 0; }
  /// Another owner has it now.
  void release() { descriptor_ = -1; }

 private:
  int descriptor_;
};

void setPermissions(int descriptor, unsigned permissions);
void removeFile(const std::string& path);
/// The file takes the other name, and the place of what has it.
[[nodiscard]] bool replaceFile(const std::string& from, const std::string& to);
[[nodiscard]] std::uint64_t processNumber();

/// The path without links, as far as there is one yet. Nothing if one of them, on the way or at the
/// end, is another user's trap.
[[nodiscard]] std::optional<std::string> withoutLinks(const std::string& path);

}  // namespace foretouch::internal
