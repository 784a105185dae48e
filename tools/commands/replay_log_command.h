// tools/commands/replay_log_command.h: `foretouch replay` of an event log.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/log/replay_log.h"
#include "tools/report/document_parts.h"

namespace foretouch::tools {

struct LogReplayJob {
  LogReplayRequest request;
  std::string outputPath;
  ReportOptions report;
};

/// Runs a job: results to the output file, the report to its own, each of which appears once it is
/// complete or not at all, and the summary's text to `tell`.
[[nodiscard]] Result<LogReplayReport> runLogReplay(
    const LogReplayJob& job, const std::function<void(const std::string&)>& tell);

}  // namespace foretouch::tools
