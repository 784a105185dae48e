// tools/report/report_file.h: makes a document and writes it as a report, with progress, and
// interruptible.
#pragma once

#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/interrupt.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// Makes a document and reports progress.
using DocumentMaker = std::function<Result<ViewDocument>(const ReportProgress& progress)>;

/// Writes the document of `make` to `path`, as a page that needs no network and no other file. It
/// appears once it is complete, and not at all if `guard` was interrupted.
[[nodiscard]] Result<Done> writeReport(const std::string& path, const InterruptGuard& guard,
                                       const DocumentMaker& make);

}  // namespace foretouch::tools
