// middleware/query_counters.h: how much work a query did, and the counters by name, for code that
// sums or prints them all.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace foretouch {

/// Work done, for measurements that do not depend on the machine's load.
struct QueryCounters {
  std::uint64_t nodes = 0;         ///< Nodes of the tree visited.
  std::uint64_t leaves = 0;        ///< Leaves of the tree visited (in lanes).
  std::uint64_t candidates = 0;    ///< (LSS, triangle) pairs that passed the culling.
  std::uint64_t clusterSteps = 0;  ///< Evaluations in lanes of an LSS and a leaf's sphere.
  std::uint64_t laneSteps = 0;     ///< Evaluations in lanes of an LSS and a triangle.
  std::uint64_t partSteps = 0;  ///< At exact and skinned fidelity: evaluations of parts in lanes.
  std::uint64_t advancements = 0;    ///< Scalar distance evaluations, all kinds together.
  std::uint64_t hierarchyTests = 0;  ///< At exact fidelity: of an LSS or a node below it.
  std::uint64_t planeTests = 0;      ///< At exact fidelity: of a part against its parent's plane.
  std::uint64_t cubicTests = 0;      ///< By the reference room's cubics: pieces of pairs.
  std::uint64_t leafTests = 0;       ///< At exact fidelity: of two triangles.
  std::uint64_t states = 0;          ///< Link states evaluated (forward kinematics).
  std::uint64_t rungTests = 0;     ///< By the reference room: of volumes that cover several links.
  std::uint64_t settledAbove = 0;  ///< Links that the reference room's reach settled.
};

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
