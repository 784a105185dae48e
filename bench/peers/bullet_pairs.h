// bench/peers/bullet_pairs.h: the Bullet physics library on two LSS that both move.
#pragma once

#include "bench/peers/moving_pairs.h"

namespace foretouch::tools {

/// btContinuousConvexCollision of two motions: the whole, and pieces that turn little enough.
[[nodiscard]] PairSolvers bulletPairSolvers();

}  // namespace foretouch::tools
