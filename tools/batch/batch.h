// tools/batch/batch.h: does the jobs of a manifest, several at a time, each as a process of its
// own. What is done is never done again, and what fails stops nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/batch/manifest.h"

namespace foretouch::tools {

/// The jobs of the i-th of n workers, counted from 1: jobs i, i + n, i + 2 n...
struct BatchShard {
  std::size_t index = 1, count = 1;
};

struct BatchPlan {
  std::string program;  ///< The program that does the jobs.
  std::string version;  ///< The program's version (versionOf()).
  std::string results;  ///< A folder that exists; absolute.
  BatchShard shard;
  int threads = 1;          ///< Jobs at a time; each runs one thread.
  double jobSeconds = 0.0;  ///< A job that takes longer fails; 0: none does.
  bool makesReports = false;
};

struct BatchTally {
  std::size_t jobs = 0;      ///< Jobs of the shard.
  std::size_t done = 0;      ///< Done by this run.
  std::size_t kept = 0;      ///< Done before this run.
  std::size_t repeated = 0;  ///< The same as another job.
  std::size_t failed = 0;
  std::size_t left = 0;  ///< Not begun: the run was stopped.
};

/// The version that the program reports. Errors: it does not start, or says nothing.
[[nodiscard]] Result<std::string> versionOf(const std::string& program);

/// Reports each job that fails as an error on stderr. `stop`: asked often; true ends the run
/// early. Errors: a result that cannot be written, which ends the run.
[[nodiscard]] Result<BatchTally> runBatch(const BatchManifest& manifest, const BatchPlan& plan,
                                          const std::function<bool()>& stop);

}  // namespace foretouch::tools
