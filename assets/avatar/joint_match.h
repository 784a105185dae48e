// assets/avatar/joint_match.h: which joint of a clip drives which joint of an avatar.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch {

/// Avatar joint name -> clip joint name, for names that differ.
using JointNameMap = std::map<std::string, std::string>;

/// Matches by name only; lists joints without a match, never guesses.
struct JointMatch {
  std::vector<JointId> clipJointOf;          ///< Per avatar joint; kNoParent if the clip has none.
  std::vector<std::string> unmatchedAvatar;  ///< Avatar joints that keep their rest values.
  std::vector<std::string> unmatchedClip;    ///< Clip joints that drive nothing.
};

/// Error if no joint matches at all, or if `names` mentions a joint that neither side has.
[[nodiscard]] Result<JointMatch> matchJoints(const Skeleton& avatar, const Skeleton& clip,
                                             const JointNameMap& names = {});

/// How many times as long the clip's bones are as the avatar's, over the matched joints, if that is
/// more than twice or less than half: a sign of a wrong unit. People differ by less.
[[nodiscard]] std::optional<double> suspiciousSize(const Skeleton& avatar, const Skeleton& clip,
                                                   const JointMatch& match);

/// The clip's frame as a pose of the avatar. Joints without data keep the avatar's rest values; a
/// joint without position channels keeps the avatar's rest offset. `frame` is within the clip.
[[nodiscard]] Pose poseOfAvatar(const Skeleton& avatar, const Clip& clip, const JointMatch& match,
                                std::size_t frame);

/// The place of a clip in the scene: first Z-up to Y-up ((x,y,z) becomes (x,z,-y)) if `motionUpZ`,
/// then the rotation by `yawDeg` about +Y, then the translation `origin` (metres). Applies to
/// roots. `origin` may move a pose beyond kMaxCoordinate: call validatedPose() again before use.
struct Placement {
  bool motionUpZ = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double yawDeg = 0.0;
};

[[nodiscard]] Pose placed(const Skeleton& skeleton, Pose pose, const Placement& placement);

}  // namespace foretouch
