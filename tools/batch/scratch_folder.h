// tools/batch/scratch_folder.h: where a worker makes what it later moves into place.
#pragma once

#include <string>

#include "articulated/result.h"

namespace foretouch::tools {

/// A folder that only this worker uses, inside the folder of results; its destructor removes it. If
/// a worker was killed, the next one removes its folder: the kernel has freed the lock.
class ScratchFolder {
 public:
  static Result<ScratchFolder> create(const std::string& results);
  ScratchFolder(ScratchFolder&& other) noexcept;
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder();

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  ScratchFolder(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::string path_;
  int lock_ = -1;
};

}  // namespace foretouch::tools
