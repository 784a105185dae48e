// tools/commands/solid_replay.h: `foretouch replay --solid`.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/glb/replay_glb.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/report/document_parts.h"
#include "tools/settings/solid_settings.h"
#include "tools/solid/solid_summary.h"

namespace foretouch::tools {

/// A solid replay with checked options.
struct SolidReplayJob {
  ReplayRequest request;
  SolidRequest solid;
  bool hasTolerance = false;  ///< The request's tolerance was asked for; else it follows the skin.
  std::string outputPath, bvhPath;
  ReportOptions report;
  GlbRequest glb;
};

/// Runs a job: remarks on stderr, shown poses to the output file, page, GLB and BVH to their own,
/// and the summary to `tell`. Each file appears once it is complete, and not at all after an error
/// or a signal, which ends the program.
[[nodiscard]] Result<Done> runSolidReplay(const SolidReplayJob& job,
                                          const std::function<void(const SolidSummary&)>& tell);

/// Refuses those of a replay's settings that a solid avatar cannot honour.
[[nodiscard]] Result<Done> checkSolidTogether(const Settings& settings,
                                              const WorldRequest& request);

}  // namespace foretouch::tools
