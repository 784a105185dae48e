// tools/report/report_progress.h: long work that can be watched and ended.
#pragma once

#include <cstdint>
#include <functional>

namespace foretouch::tools {

/// Told how much is done; false ends the work.
using ReportProgress = std::function<bool(std::int64_t done, std::int64_t total)>;

}  // namespace foretouch::tools
