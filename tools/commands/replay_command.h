// tools/commands/replay_command.h: `foretouch replay`.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/glb/replay_glb.h"
#include "tools/person/person_touches.h"
#include "tools/replay/replay.h"
#include "tools/replay/summary.h"
#include "tools/report/document_parts.h"
#include "tools/settings/command_line.h"

namespace foretouch::tools {

[[nodiscard]] Command replayCommand();

/// A replay with checked options.
struct ReplayJob {
  ReplayRequest request;
  int threads = 1;
  std::string outputPath;
  ReportOptions report;
  GlbRequest glb;
  PersonRequest person;
};

/// Runs a job: remarks on stderr, results to the output file, the report to its own, and the
/// summary to `tell`. Each file appears once it is complete; after an error or a signal, which ends
/// the program, not at all. `tell` is also given what the person touched, for people; empty if that
/// is not asked.
[[nodiscard]] Result<Done> runReplay(
    const ReplayJob& job,
    const std::function<void(const ReplaySummary&, const std::string& person)>& tell);

}  // namespace foretouch::tools
