// tools/inputs/first_pose.h: how a body begins: the box around it, and whether it stands.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "assets/file_frame.h"

namespace foretouch::tools {

/// The box around all LSS, in the world; empty if the avatar has none. `pose`: a validated one.
[[nodiscard]] Eigen::AlignedBox3d boxInPose(const Avatar& avatar, const Pose& pose);

/// How a person's head is above the feet, by the joints' names.
struct Stance {
  Eigen::Vector3d headFromFeet;  ///< W: from between the ankles to the head.

  /// A person who bends, sits or crouches still does; one who lies or hangs head down does not.
  [[nodiscard]] bool isUpright() const {
    constexpr double kLeast = 0.5;  // of the distance: up to 60 degrees off the vertical
    return headFromFeet.y() >= kLeast * headFromFeet.norm();
  }
};

/// Nothing if the names of head and feet say nothing: an animal or a thing need not stand.
[[nodiscard]] std::optional<Stance> stanceOf(const Skeleton& skeleton, const Pose& pose);

/// A doubt, as a sentence, about a clip whose first pose (in the world) does not stand, with the
/// axis that would let it stand, if one does. `frame`: what the clip was read with.
[[nodiscard]] std::optional<std::string> remarkOnFirstPose(const Avatar& avatar, const Pose& pose,
                                                           const FileFrame& frame,
                                                           const std::string& motionPath);

/// The options that name a file's unit and axis.
struct FrameOptions {
  const char* scale;
  const char* up;
};

/// Says so if an option repeats what the file says about itself, or stands in place of it.
[[nodiscard]] std::optional<std::string> remarkOnFrame(const FileFrame& frame,
                                                       const FrameOptions& options,
                                                       const std::string& path);

}  // namespace foretouch::tools
