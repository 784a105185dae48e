// tools/report/inspection.h: a scene, an avatar and a clip, or any of them, as a view document: for
// a look before a run, to see whether units, axes and placement are right.
#pragma once

#include <memory>

#include "articulated/result.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/report/document_parts.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// The inspected inputs, read and matched.
struct Inspected;

/// Skips empty paths; at least one is not empty (asserted). Shows a clip without an avatar on the
/// one that avatarFromClip() makes of it. Errors name the file or option.
[[nodiscard]] Result<std::shared_ptr<const Inspected>> inspect(const ReplayRequest& request);

/// Its summary has the measured sizes, its notes what looks wrong. `inspected` must outlive it.
[[nodiscard]] Result<ViewDocument> documentOf(const Inspected& inspected,
                                              const ReportOptions& options,
                                              const ReportProgress& progress);

}  // namespace foretouch::tools
