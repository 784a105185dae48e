// assets/text_file.h: reads and writes whole files. Not installed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/quoted.h"
#include "articulated/result.h"

namespace foretouch {

/// Reads a regular file of at most `limitBytes`. Errors: not found, a directory or unreadable,
/// larger.
[[nodiscard]] Result<std::string> readWholeFile(const std::string& path, std::size_t limitBytes);

/// A file that appears under its name only once it is complete: goes to a temporary file in the
/// same folder; commit() flushes and renames it. Without commit() it leaves nothing behind. Follows
/// symbolic links and replaces the file behind them, keeping its permissions; refuses a path on
/// which another user's link lies in a sticky folder that all may write to (/tmp). Another user's
/// folder is theirs, and so is what is written there. Writes directly to anything but a regular
/// file (a pipe), because there is nothing to rename over, and to /dev/stdout, whatever that
/// is.
class PendingFile {
 public:
  static Result<PendingFile> create(const std::string& path);
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  /// Appends; commit() reports a failure.
  void write(std::string_view text);
  [[nodiscard]] Result<Done> commit();

 private:
  PendingFile(std::string path, std::string target, std::string temporary, int descriptor);
  void flush();
  void discard() noexcept;
  std::string path_;       ///< As the caller gave it: for errors.
  std::string target_;     ///< With symbolic links resolved.
  std::string temporary_;  ///< Empty if writing directly to the target.
  int descriptor_ = -1;
  int failure_ = 0;  ///< The first errno, 0 if none.
  std::string buffer_;
};

}  // namespace foretouch
