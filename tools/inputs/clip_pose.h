// tools/inputs/clip_pose.h: a frame of a clip as an avatar's pose in a scene.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"

namespace foretouch::tools {

/// A clip, its avatar, and its placement. The objects it refers to must outlive it.
struct PlacedClip {
  const Avatar& avatar;
  const Clip& clip;
  const JointMatch& match;
  Placement placement;
  bool isUpright = false;   ///< As in Motion::isUpright: the placement does not turn it again.
  const std::string& path;  ///< For errors.
};

/// The avatar's placed pose at a frame. Error if it lies beyond the limit of coordinates. `frame`
/// is within the clip.
[[nodiscard]] Result<Pose> poseAtFrame(const PlacedClip& placed, std::int64_t frame);

}  // namespace foretouch::tools
