// tools/log/log_to_bvh.h: one avatar's poses of an event log as a BVH file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/log/log_loss.h"

namespace foretouch::tools {

struct LogToBvhRequest {
  std::string logPath;
  std::string suffix;       ///< The suffix of the channels.
  std::int32_t avatar = 1;  ///< The avatar whose poses are taken.
};

struct BvhOfLog {
  std::string text;
  std::int64_t frames = 0;
  /// Facts missing in the file, one sentence each: lost poses, times that are not equally spaced,
  /// poses that came late or twice.
  std::vector<std::string> notes;
};

/// Errors name the log: no pose or no skeleton of the avatar, more than one session or skeleton, a
/// pose without some joint. Records the losses of a damaged log in `loss`, whether or not the rest
/// makes a file. Memory: the log's poses.
[[nodiscard]] Result<BvhOfLog> logToBvh(const LogToBvhRequest& request, LogLoss& loss);

}  // namespace foretouch::tools
