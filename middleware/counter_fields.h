// middleware/counter_fields.h: the counters of a query by name, for code that sums or prints them
// all.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "middleware/query_counters.h"

namespace foretouch {

/// Add a counter here and every benchmark reports it.
inline constexpr std::array<std::pair<const char*, std::uint64_t QueryCounters::*>, 14>
    kCounterFields{{{"nodes", &QueryCounters::nodes},
                    {"leaves", &QueryCounters::leaves},
                    {"candidates", &QueryCounters::candidates},
                    {"cluster_steps", &QueryCounters::clusterSteps},
                    {"lane_steps", &QueryCounters::laneSteps},
                    {"part_steps", &QueryCounters::partSteps},
                    {"advancements", &QueryCounters::advancements},
                    {"hierarchy_tests", &QueryCounters::hierarchyTests},
                    {"plane_tests", &QueryCounters::planeTests},
                    {"cubic_tests", &QueryCounters::cubicTests},
                    {"leaf_tests", &QueryCounters::leafTests},
                    {"states", &QueryCounters::states},
                    {"rung_tests", &QueryCounters::rungTests},
                    {"settled_above", &QueryCounters::settledAbove}}};
static_assert(sizeof(QueryCounters) == kCounterFields.size() * sizeof(std::uint64_t),
              "name the new counter above");

}  // namespace foretouch
