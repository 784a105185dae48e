// middleware/solid/tree_pose.h: where a pose places the links, and poses a small step away. Metres,
// radians. Not installed.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/skeleton.h"

namespace foretouch::internal {

/// The links' places in W at `pose`, in order; velocities are zero. O(joints).
void placeLinks(const Skeleton& skeleton, const Pose& pose, std::vector<LinkState>& states);

/// A change of pose to first order: joint j turns by `turn[j]` (a rotation vector in W, about the
/// joint's origin), and its parent-relative translation changes by `shift[j]` (in its parent's
/// frame, roots: in W).
struct PoseStep {
  std::vector<Eigen::Vector3d> turn, shift;
  void resize(std::size_t joints) {
    turn.assign(joints, Eigen::Vector3d::Zero());
    shift.assign(joints, Eigen::Vector3d::Zero());
  }
};

/// `pose` a share of `step` on: q' = exp(R_PW turn) q, which is the slerp whose velocity at its
/// begin is the step's. `states` are the links' places at `pose`. Resizes `moved`.
void moveBy(const Skeleton& skeleton, const Pose& pose, const std::vector<LinkState>& states,
            const PoseStep& step, double share, Pose& moved);

/// The rotation vector (in the parent's frame) that turns `from` into `to` on the shorter arc.
[[nodiscard]] Eigen::Vector3d turnBetween(const Quaternion& from, const Quaternion& to);

/// The same rotations and translations, bit for bit.
[[nodiscard]] bool isSamePose(const Pose& x, const Pose& y);

}  // namespace foretouch::internal
