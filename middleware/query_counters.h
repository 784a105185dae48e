// middleware/query_counters.h: how much work a query did.
#pragma once

#include <cstdint>

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

}  // namespace foretouch
