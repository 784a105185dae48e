// tools/report/report_progress.h: long work with progress and early end.
#pragma once

#include <cstdint>
#include <functional>

namespace foretouch::tools {

/// Gets the amount done; returns false to end the work.
using ReportProgress = std::function<bool(std::int64_t done, std::int64_t total)>;

}  // namespace foretouch::tools
