// bench/solid/arm_targets.h: poses of the trials' figure (figure.h) with its right arm led by a
// hand. Metres, radians, W.
#pragma once

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "lss/index.h"
#include "tools/portable_random.h"

namespace foretouch::tools {

/// The figure's right arm and its joints.
struct RightArm {
  explicit RightArm(const Avatar& figure);

  std::size_t arm, foreArm, hand;
  Eigen::Vector3d shoulder;  ///< At rest.
};

/// The figure at rest but for the right arm, which reaches with its wrist for `wrist`, elbow down,
/// and points with its hand to -z. Beyond its reach: stretched towards it.
[[nodiscard]] Pose reachingFor(const Avatar& figure, const RightArm& right,
                               const Eigen::Vector3d& wrist);

/// The figure at rest but for the right arm, which points anywhere in front or to its side.
[[nodiscard]] Pose pointingAnywhere(const Avatar& figure, const RightArm& right,
                                    PortableRandom& random);

}  // namespace foretouch::tools
