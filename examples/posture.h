// examples/posture.h: from a choreographer's posture (places of hips, feet and hands) to the
// rotation of every joint.
#pragma once

#include <Eigen/Core>

#include "articulated/skeleton.h"

namespace foretouch::examples {

/// Metres in the room's frame W and degrees, unless said otherwise. A yaw of 0 faces +Z, of 90 +X.
struct Posture {
  struct Foot {
    Eigen::Vector3d ball = Eigen::Vector3d::Zero();  ///< Under the joint of the toes, on the sole.
    double yaw = 0.0, pitch = 0.0;                   ///< Pitch > 0: the heel is up.
  };
  struct Hand {
    /// The wrist, relative to the middle between the shoulders in the chest's frame: to its own
    /// side, up, forward.
    Eigen::Vector3d wrist = Eigen::Vector3d::Zero();
    double grip = 0.0;  ///< 0: flat, 1: a fist.
  };
  Eigen::Vector3d hips = Eigen::Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0, roll = 0.0;   ///< The hips'; pitch > 0: bent forward.
  double twist = 0.0, bend = 0.0, lean = 0.0;  ///< The chest's against the hips: yaw, pitch, roll.
  double gaze = 0.0, nod = 0.0;                ///< The head's against the chest: yaw, pitch.
  Foot leftFoot, rightFoot;
  Hand leftHand, rightHand;
};

/// Solves limbs in closed form (two bones and a target); they point at a target out of reach.
[[nodiscard]] Pose poseOf(const Skeleton& dancer, const Posture& posture);

}  // namespace foretouch::examples
