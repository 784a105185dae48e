// tools/report/report_file.h: a document worked out and written as a report, while a person may be
// watching or may have had enough.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/interrupt.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// Makes a document, saying how far it is.
using DocumentMaker = std::function<Result<ViewDocument>(const ReportProgress& progress)>;

/// Writes what `make` makes to `path`, a page that needs no network and no file beside it. It
/// appears once it is complete, or not at all: not where `guard` was told to stop.
[[nodiscard]] Result<Done> writeReport(const std::string& path, const InterruptGuard& guard,
                                       const DocumentMaker& make);

}  // namespace foretouch::tools
