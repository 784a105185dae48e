// examples/dancer_body.h: the skeleton and the volumes of the person who moves in the room.
// 1.74 m tall, rest pose: standing upright, arms stretched to the sides, palms down, facing +Z;
// left is +X.
#pragma once

#include <cstdint>

#include "articulated/avatar.h"
#include "articulated/result.h"

namespace foretouch::examples {

/// The joints that the posture solver names. Those of the right side follow at the same distances.
enum Joint : std::int32_t {
  kHips,
  kSpine,
  kSpine1,
  kSpine2,
  kNeck,
  kHead,
  kLeftShoulder,
  kLeftArm,
  kLeftForeArm,
  kLeftHand,
  kLeftFingers,
  kLeftThumb,
  kRightShoulder,
  kRightArm,
  kRightForeArm,
  kRightHand,
  kRightFingers,
  kRightThumb,
  kLeftUpLeg,
  kLeftLeg,
  kLeftFoot,
  kLeftToeBase,
  kRightUpLeg,
  kRightLeg,
  kRightFoot,
  kRightToeBase,
  kNumDancerJoints
};

/// The avatar: one LSS per link, two side by side for the links of the trunk.
[[nodiscard]] Result<Avatar> dancerAvatar();

}  // namespace foretouch::examples
