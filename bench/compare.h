// bench/compare.h: the same steps as three models see them: the product, a check of the two poses
// alone, and rigid links that know only their own two poses; and, at exact fidelity, the links'
// LSS.
#pragma once

#include "articulated/result.h"
#include "bench/report.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {

/// Every step of the clip, on one thread. Errors name the file or option.
[[nodiscard]] Result<BenchReport> measureComparison(const ReplayRequest& request);

}  // namespace foretouch::tools
