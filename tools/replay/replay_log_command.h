// tools/replay/replay_log_command.h: `foretouch replay` of an event log.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/replay/replay_log.h"

namespace foretouch::tools {

struct LogReplayJob {
  LogReplayRequest request;
  std::string outputPath;
};

/// Runs a job: results to the output file, which appears once it is complete or not at all, and the
/// summary's text to `report`.
[[nodiscard]] Result<LogReplayReport> runLogReplay(
    const LogReplayJob& job, const std::function<void(const std::string&)>& report);

}  // namespace foretouch::tools
