// tools/batch/job_name.h: the name of a job's result: a hash of all that it depends on.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tools/batch/manifest.h"

namespace foretouch::tools {

/// The marks of files, by their content; reads each file once, however many jobs name it, and
/// again if it has changed since. May be used from several threads.
class FileMarks {
 public:
  /// `folder`: the folder to which paths are relative.
  explicit FileMarks(std::string folder) : folder_(std::move(folder)) {}

  /// The mark of the file, all files that it names (namesIn()), and those that these name. A file
  /// that is not there has a mark, too.
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
    std::vector<std::string> names;  ///< Files that it names, absolute or relative to our folder.
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
/// of an avatar or a URDF. As the text has them, without the file's own folder; "package://name/"
/// left out.
[[nodiscard]] std::vector<std::string> namesIn(const std::string& text);

/// Thirty-two hexadecimal digits: a hash of the program's version, the options that differ from
/// their defaults, and the files' names (without folders) and contents. It does not depend on the
/// manifest, on where the files lie, or on how the job runs.
[[nodiscard]] std::string jobName(const BatchJob& job, const std::string& version,
                                  FileMarks& marks);

}  // namespace foretouch::tools
