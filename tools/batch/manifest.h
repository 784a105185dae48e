// tools/batch/manifest.h: many replays as a text says them, format "foretouch-batch" version 1
// (docs/fleets.md). A job's words are those of `foretouch replay`. No file of a job is loaded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxManifestBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxManifestLine = std::size_t{64} << 10;
inline constexpr std::size_t kMaxBatchJobs = 1'000'000;

/// What each job is.
enum class BatchKind : std::uint8_t { Replays, Feet };
/// "replay", "feet".
[[nodiscard]] const char* commandOf(BatchKind kind);
/// The ending of the file with a job's results: ".jsonl", ".csv".
[[nodiscard]] const char* endingOf(BatchKind kind);

/// An option of that command with its value, legal by itself.
struct JobOption {
  std::string name;                ///< "--scene"
  std::vector<std::string> texts;  ///< None for a flag; several for an option that is a list.
  std::string value;               ///< One spelling for all ways to write the same value.
  bool isFile = false;             ///< Each text is the path of a file that the job reads.
  bool isDefault = false;          ///< The job is as if it were not given.
};

/// One replay. Options are shared among the jobs that have them, in the order of replay's help.
struct BatchJob {
  std::int64_t line = -1;  ///< Its line in the manifest.
  std::vector<std::shared_ptr<const JobOption>> options;

  /// Nothing if the option is not given.
  [[nodiscard]] const JobOption* find(std::string_view name) const;
  /// The command line, without the program's and the command's name.
  [[nodiscard]] std::vector<std::string> words() const;
};

struct BatchManifest {
  std::string path;
  std::string folder;  ///< The manifest's folder, to which its paths are relative; never empty.
  std::vector<BatchJob> jobs;
  BatchKind kind = BatchKind::Replays;
};

/// `settings`: those of the jobs' command; their values change. Expands patterns of files and
/// lists, so it looks into folders; files that are named need not exist. Errors name the line.
[[nodiscard]] Result<BatchManifest> parseManifest(std::string_view text, const std::string& path,
                                                  Settings& settings,
                                                  BatchKind kind = BatchKind::Replays);
[[nodiscard]] Result<BatchManifest> readManifest(const std::string& path, Settings& settings,
                                                 BatchKind kind = BatchKind::Replays);

}  // namespace foretouch::tools
