// middleware/edges/edge_memory.h: what questions about edges keep, and an edge as a prop sees it.
// Not installed.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "lss/index.h"
#include "middleware/contact.h"
#include "middleware/scratch.h"

namespace foretouch::internal {

struct EdgeMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::Edge;

  ChainMotion motion;
  StepContacts step;
  Pose from, to;
  Pose propFrom, propTo;  // the same as seen from a prop
  std::vector<double> q;
  std::vector<LinkState> states;
};

/// The rounding of poses seen from a prop, in parts of the distance: articulated/robot.md 3.
inline constexpr double kPropRounding = 0x1p-43;

/// The same pose, its roots as seen from the frame P.
inline void seenFrom(const RigidPose& X_WP, const Skeleton& skeleton, const Pose& pose,
                     Pose& seen) {
  seen = pose;
  const Quaternion R_PW = X_WP.rotation.conjugate();
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    if (skeleton.parent(joint) != kNoParent) continue;
    Quaternion& rotation = seen.rotations[slotOf(joint)];
    Eigen::Vector3d& translation = seen.translations[slotOf(joint)];
    rotation = (R_PW * rotation).normalized();
    translation = R_PW * (translation - X_WP.translation);
  }
}

}  // namespace foretouch::internal
