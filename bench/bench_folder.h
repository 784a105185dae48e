// bench/bench_folder.h: a folder of a benchmark's own, gone with it.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <system_error>
#include <unistd.h>

#include "articulated/result.h"
#include "articulated/try.h"
#include "assets/text_file.h"

namespace foretouch::tools {

class BenchFolder {
 public:
  BenchFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("foretouch-bench-" + std::to_string(::getpid()) + "-" + std::to_string(next()))) {
    std::error_code ignored;
    std::filesystem::create_directory(path_, ignored);
  }
  BenchFolder(const BenchFolder&) = delete;
  BenchFolder& operator=(const BenchFolder&) = delete;
  ~BenchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string path() const { return path_.string(); }
  /// The path of a new file.
  [[nodiscard]] Result<std::string> write(const std::string& name, const std::string& text) const {
    const std::string path = (path_ / name).string();
    FORETOUCH_TRY(auto file, PendingFile::create(path));
    file.write(text);
    FORETOUCH_CHECK(file.commit());
    return path;
  }

 private:
  static int next() {
    static std::atomic<int> folders{0};
    return ++folders;
  }
  std::filesystem::path path_;
};

}  // namespace foretouch::tools
