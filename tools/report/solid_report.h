// tools/report/solid_report.h: the shown poses of a solid avatar as a view document: the shown body
// with what it touches, and the tracked one as its ghost.
#pragma once

#include "articulated/result.h"
#include "tools/report/document_parts.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"
#include "tools/settings/solid_settings.h"
#include "tools/solid/shown_track.h"
#include "tools/solid/solid_summary.h"

namespace foretouch::tools {

/// `track`: finished. `progress` may end it early: the document is then unusable. The inputs of
/// `summary` must outlive the document.
[[nodiscard]] Result<ViewDocument> solidReport(const SolidSummary& summary, const ShownTrack& track,
                                               const SolidRequest& solid,
                                               const ReportOptions& options,
                                               const ReportProgress& progress);

}  // namespace foretouch::tools
