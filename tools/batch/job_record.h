// tools/batch/job_record.h: what a batch keeps of a job: one line of JSON, whole or not there. Its
// place, and that of the results, follow from the job's name alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

struct JobRecord {
  std::string name;
  bool isDone = false;
  std::string error;    ///< Why the job failed, if it did.
  std::string mark;     ///< The mark of the file of its results (file_mark.h).
  std::string summary;  ///< A JSON object: the replay's, without what no second run would repeat.
};

/// The replay's summary (its --json) without its paths, latencies and threads. Nothing if it is
/// not a JSON object.
[[nodiscard]] std::optional<std::string> lastingSummary(std::string_view line);

[[nodiscard]] std::string recordLine(const JobRecord& record);
/// Nothing unless every byte is as recordLine() wrote it and the record is about this job.
[[nodiscard]] std::optional<JobRecord> parseRecord(std::string_view line, const std::string& name);

/// Where the results of all jobs are.
class ResultFolder {
 public:
  /// `ending`: that of the files with the results.
  explicit ResultFolder(std::string path, const char* ending = ".jsonl")
      : path_(std::move(path)), ending_(ending) {}

  [[nodiscard]] const std::string& path() const { return path_; }
  /// "4f/4f0c....jsonl" for ".jsonl".
  [[nodiscard]] static std::string placeOf(const std::string& name, const char* ending);
  [[nodiscard]] std::string fileOf(const std::string& name, const char* ending) const {
    return path_ + "/" + placeOf(name, ending);
  }

  /// The record, if it is whole and the results are byte for byte those that it names; a failed
  /// job needs only the record. Records from before there were marks give nothing: such a job is
  /// done again.
  [[nodiscard]] std::optional<JobRecord> find(const std::string& name) const;
  /// Moves results with these endings, then the record that names them, out of `scratch`, a folder
  /// on the same file system; for a failed job only the record. Each is there whole, or as it was
  /// before. False, and nothing moved, if another worker has done the job meanwhile. Workers on one
  /// job take turns, so that no record names another's results; where the file system has no
  /// locks, that can happen, and find() then says that the job is to be done again.
  [[nodiscard]] Result<bool> put(const JobRecord& record, const std::string& scratch,
                                 const std::vector<const char*>& endings = {}) const;

 private:
  std::string path_;
  const char* ending_;
};

}  // namespace foretouch::tools
