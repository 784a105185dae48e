// bench/pool.h: many avatars in one scene, on several threads.
#pragma once

#include <vector>

#include "articulated/result.h"
#include "bench/workload.h"
#include "middleware/query/query.h"

namespace foretouch::tools {

/// The times of a crowd of avatars.
struct CrowdTimes {
  double wallS = 0.0;
  std::int64_t steps = 0;
  std::int64_t contacts = 0;      ///< Links; does not depend on the threads.
  std::vector<double> instantUs;  ///< Of all avatars' steps together, one per instant.
};

/// Instant by instant, every avatar takes one step, and a WorkerPool answers them all: avatar a
/// starts `steps.size() * a / avatars` steps into the list.
[[nodiscard]] Result<CrowdTimes> timeCrowd(const Avatar& avatar,
                                           const std::vector<StepPoses>& steps, const Scene& scene,
                                           const QueryOptions& query, int avatars, int instants,
                                           int threads);

}  // namespace foretouch::tools
