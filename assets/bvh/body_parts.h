// assets/bvh/body_parts.h: the parts of a person's body, found by the names of its joints.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "articulated/pose.h"
#include "articulated/skeleton.h"

namespace foretouch {

/// From the middle of the ankles to the head (without one: the neck, or the last joint of the
/// torso), as the pose holds them; in the frame of the roots' parent, in its unit. Nothing if the
/// names show no ankles or nothing above them.
[[nodiscard]] std::optional<Eigen::Vector3d> footToHead(const Skeleton& skeleton, const Pose& pose);

/// Pelvis, torso, neck and head: what stays free where a person goes. All links if the names show
/// none of them.
[[nodiscard]] std::vector<LinkId> trunkOf(const Skeleton& skeleton);

/// Feet and toes: what stands on the ground. None if the names show none.
[[nodiscard]] std::vector<LinkId> feetOf(const Skeleton& skeleton);

}  // namespace foretouch
