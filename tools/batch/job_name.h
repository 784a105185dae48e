// tools/batch/job_name.h: the name of a job's result: a hash of all that it depends on.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tools/batch/manifest.h"

namespace foretouch::tools {

/// Files and what is in them; reads each once, however many jobs name it, and again where it has
/// changed since. May be used from several threads.
class FileMarks {
 public:
  /// `folder`: to which paths are relative.
  explicit FileMarks(std::string folder) : folder_(std::move(folder)) {}

  /// Of the file and of all files that it names (namesIn()), and those that these name. A file that
  /// is not there has a mark, too.
  [[nodiscard]] std::string of(const std::string& path);

 private:
  struct Stamp {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = -1, seconds = 0, nanoseconds = 0;
    [[nodiscard]] bool operator==(const Stamp& other) const;
  };
  struct Known {
    Stamp stamp;
    std::string mark;
    std::vector<std::string> names;  ///< Of files that it names, absolute or relative to ours.
  };

  [[nodiscard]] static Stamp stampOf(const std::string& path);
  [[nodiscard]] Known read(const std::string& path) const;
  [[nodiscard]] Known known(const std::string& path);
  void collect(const std::string& path, int depth, std::map<std::string, std::string>& marks);

  std::string folder_;
  std::mutex mutex_;
  std::map<std::string, Known> known_;
};

/// Texts in double quotes that are names of files beside a file: the buffers of a glTF, the meshes
/// of an avatar or a URDF. Without the file's own folder, as the text has them; "package://name/"
/// left out.
[[nodiscard]] std::vector<std::string> namesIn(const std::string& text);

/// Thirty-two hexadecimal digits: of the program's version, of the options that are not as by
/// default, and of the files' names (without folders) and contents. Not of the manifest, of where
/// the files lie, or of how the job runs.
[[nodiscard]] std::string jobName(const BatchJob& job, const std::string& version,
                                  FileMarks& marks);

}  // namespace foretouch::tools
