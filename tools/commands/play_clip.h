// tools/commands/play_clip.h: a recorded clip, from its files to results, report and GLB.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/glb/replay_glb.h"
#include "tools/person/person_touches.h"
#include "tools/replay/replay.h"
#include "tools/replay/summary.h"
#include "tools/report/document_parts.h"

namespace foretouch::tools {

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
/// summary to `tell`. Each file appears once it is complete, and not at all after an error or a
/// signal, which ends the program. `tell` also gets what the person touched, for people; empty if
/// the job does not ask for that.
[[nodiscard]] Result<Done> runReplay(
    const ReplayJob& job,
    const std::function<void(const ReplaySummary&, const std::string& person)>& tell);

}  // namespace foretouch::tools
