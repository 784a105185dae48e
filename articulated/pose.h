// articulated/pose.h: the place of every joint at one instant.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"

namespace foretouch {

/// A frame in another one.
struct RigidPose {
  Quaternion rotation = Quaternion::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< Metres.
};

/// Parent-relative pose of every joint of one Skeleton, in its order (roots: in the world W).
/// `rotations[j]` replaces the rest rotation, `translations[j]` (metres) replaces the rest offset.
struct Pose {
  std::vector<Quaternion> rotations;
  std::vector<Eigen::Vector3d> translations;
};

/// The pose in which every joint has its rest values.
[[nodiscard]] Pose restPose(const Skeleton& skeleton);

/// Checks a pose against its skeleton (joint count, finite values, |translation| <= kMaxCoordinate,
/// quaternion norms within kMaxQuaternionNormError) and renormalises its rotations.
/// Error::index is the offending joint.
[[nodiscard]] Result<Pose> validatedPose(const Skeleton& skeleton, Pose pose);
/// The same check and renormalisation in place, without a copy; `pose` is unchanged on error.
Result<Done> validate(const Skeleton& skeleton, Pose& pose);

}  // namespace foretouch
