// bench/peers/fcl_pairs.h: the Flexible Collision Library on two bodies that both move.
#pragma once

#include "bench/peers/moving_pairs.h"

namespace foretouch::tools {

/// FCL's distance advanced by hand (1e-3 m), and continuousCollide() of two motions (10 and 100
/// samples).
[[nodiscard]] PairSolvers fclPairSolvers(PairKind kind);

}  // namespace foretouch::tools
