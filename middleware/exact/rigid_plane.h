// middleware/exact/rigid_plane.h: a rigid query that begins with a plane its caller knows already.
// Not installed.
#pragma once

#include <Eigen/Core>

#include "lss/triangle.h"
#include "middleware/exact/nlerp_motion.h"

namespace foretouch::internal {

/// As rigidTrianglePair(), and with the same promise. `nhat_W`: from the fixed triangle towards the
/// moving one, no longer than 1; where a plane across it keeps them apart for a while, the closest
/// points are first looked for after that. Any direction will do, a poor one proves nothing.
[[nodiscard]] RigidAnswer rigidTrianglePairFromPlane(const NlerpMotion& motion,
                                                     const Triangle& moving_L,
                                                     const Triangle& fixed_W, double band,
                                                     const Eigen::Vector3d& nhat_W);

}  // namespace foretouch::internal
