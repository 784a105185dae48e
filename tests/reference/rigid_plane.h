// tests/reference/rigid_plane.h: a rigid query that begins with a plane from its caller.
#pragma once

#include <Eigen/Core>

#include "lss/lss.h"
#include "tests/reference/nlerp_motion.h"

namespace foretouch::internal {

/// As rigidTrianglePair(), and with the same promise. `nhat_W`: from the fixed triangle towards the
/// moving one, no longer than 1. If a plane normal to it separates them for a while, the query
/// skips that while. Any direction is valid; a poor one proves nothing.
[[nodiscard]] RigidAnswer rigidTrianglePairFromPlane(const NlerpMotion& motion,
                                                     const Triangle& moving_L,
                                                     const Triangle& fixed_W, double band,
                                                     const Eigen::Vector3d& nhat_W);

}  // namespace foretouch::internal
