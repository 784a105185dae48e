// bench/generated_queries.h: leaf queries generated from a seed, for timing without a query set.
// Unlabelled: they judge nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/query_set.h"
#include "tests/reference/rigid_query.h"

namespace foretouch::tools {

/// Half of the queries have a meeting at a random instant, half are random: points in a box of 1 m,
/// moving up to 1 m. The same on every machine.
[[nodiscard]] std::vector<LabelledQuery> generatedQueries(QueryKind kind, std::size_t count,
                                                          std::uint64_t seed);

/// A triangle of 0.1 m on a body that moves up to 0.5 m and turns up to one radian, and one at
/// rest.
struct RigidPair {
  NlerpMotion motion;
  Triangle moving_L, fixed_W;
};
[[nodiscard]] std::vector<RigidPair> generatedRigidPairs(std::size_t count, std::uint64_t seed);

}  // namespace foretouch::tools
