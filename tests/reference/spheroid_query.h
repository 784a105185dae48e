// tests/reference/spheroid_query.h: the first contact of a moving spheroid with the scene.
#pragma once

#include <vector>

#include "middleware/contact.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/work_meter.h"
#include "middleware/query_options.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene.h"
#include "tests/reference/spheroid.h"

namespace foretouch::internal {

struct SpheroidQuery {
  const Spheroid& spheroid;
  const Scene& scene;
  const TriangleCuller& culler;
  double tolerance;
  const WorkMeter& meter;
  const IgnoredObjects& ignored;
};

/// Every triangle's instants depend on that triangle and the spheroid alone, so the answer does not
/// depend on their order in `found`, which is scratch.
[[nodiscard]] LinkContact firstContactOf(const SpheroidQuery& query, std::vector<TriangleId>& found,
                                         QueryCounters& counters);

}  // namespace foretouch::internal
