// assets/text_file.h: whole files in, whole files out.
#pragma once

#include <cstddef>
#include <string>

#include "articulated/quoted.h"
#include "articulated/result.h"

namespace foretouch {

/// Reads a regular file of at most `limitBytes`. Errors: not found, a directory or unreadable,
/// larger.
[[nodiscard]] Result<std::string> readWholeFile(const std::string& path, std::size_t limitBytes);

/// A file that appears under its name only once it is complete: written to a temporary file in the
/// same folder, flushed, and renamed by commit(). Dropped without commit(), it leaves nothing
/// behind. A symbolic link is followed and the file behind it replaced, keeping its permissions.
/// What is no regular file (a pipe, /dev/stdout) is written to directly, as there is nothing to
/// rename over.
class PendingFile {
 public:
  static Result<PendingFile> create(const std::string& path);
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  /// Appends; a failure is remembered and reported by commit().
  void write(const std::string& text);
  [[nodiscard]] Result<Done> commit();

 private:
  PendingFile(std::string path, std::string target, std::string temporary, int descriptor);
  void flush();
  void discard() noexcept;
  std::string path_;       ///< As the caller named it: for errors.
  std::string target_;     ///< With symbolic links resolved.
  std::string temporary_;  ///< Empty where the target is written to directly.
  int descriptor_ = -1;
  int failure_ = 0;  ///< The first errno, 0 while all is well.
  std::string buffer_;
};

}  // namespace foretouch
