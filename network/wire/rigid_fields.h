// network/wire/rigid_fields.h: the pose of a rigid body as messages have it. For the codec's
// sources only.
#pragma once

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "network/wire/messages.h"

namespace foretouch {

/// The legal pose of these numbers, as they are; or why there is none.
[[nodiscard]] inline Reject readRigid(const Quaternion& rotation, const Eigen::Vector3d& position,
                                      RigidPose& pose) {
  if (!rotation.coeffs().allFinite() || !position.allFinite()) return Reject::NonFinite;
  if (!unitQuaternion(rotation)) return Reject::NonUnit;
  if (position.cwiseAbs().maxCoeff() > kMaxCoordinate) return Reject::OutOfRange;
  pose.rotation = rotation;
  pose.translation = position;
  return Reject::None;
}

}  // namespace foretouch
