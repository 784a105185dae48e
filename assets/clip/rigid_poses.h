// assets/clip/rigid_poses.h: where a rigid thing is, as a tracker saw it: poses with their instants
// as CSV text (docs/formats.md, "Poses of a prop").
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

struct TimedRigidPose {
  double timeS = 0.0;
  RigidPose pose;          ///< Finite, within kMaxCoordinate; the rotation is unit.
  std::int64_t line = -1;  ///< In its file.
};

/// Columns `time` (s), `x`, `y`, `z` (m) and, all or none, `qw`, `qx`, `qy`, `qz`, in any order
/// after `time`; one row per pose, as far apart in time as the author likes, later ones after
/// earlier ones. Errors name `name` as the file, and the line. Safe on hostile text.
[[nodiscard]] Result<std::vector<TimedRigidPose>> parseRigidPoses(std::string_view csv,
                                                                  const std::string& name);
/// The same for a file of at most kMaxJointTableBytes.
[[nodiscard]] Result<std::vector<TimedRigidPose>> readRigidPoses(const std::string& path);

}  // namespace foretouch
