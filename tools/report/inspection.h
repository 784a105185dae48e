// tools/report/inspection.h: a scene, an avatar and a clip, or any of them, as a view document:
// what somebody looks at before a run, to see whether units, axes and placement are right.
#pragma once

#include <memory>

#include "articulated/result.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/report/document_parts.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// What is looked at, read and fitted to one another.
struct Inspected;

/// Paths that are empty are of nothing that is looked at; at least one is not (asserted). A clip
/// without an avatar is shown on the one that avatarFromClip() makes of it. Errors name the file or
/// option.
[[nodiscard]] Result<std::shared_ptr<const Inspected>> inspect(const ReplayRequest& request);

/// Measured sizes as its summary, what looks wrong as its notes. `inspected` must outlive it.
[[nodiscard]] Result<ViewDocument> documentOf(const Inspected& inspected,
                                              const ReportOptions& options,
                                              const ReportProgress& progress);

}  // namespace foretouch::tools
