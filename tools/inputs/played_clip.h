// tools/inputs/played_clip.h: a clip and the avatar that it moves, read and matched: the first step
// of every command that plays a clip.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/step_selection.h"

namespace foretouch::tools {

struct PlayedClip {
  Avatar avatar;
  Clip clip;
  JointMatch match;
  StepSelection steps;
  bool isUpright = false;  ///< As in Motion::isUpright.
  FileFrame frame{};       ///< The frame of the clip's file.
  bool isByParts = false;  ///< The clip is no longer the file's: followByParts().
};

/// Errors name the file or option.
[[nodiscard]] Result<PlayedClip> loadPlayedClip(const ClipRequest& request);
/// The same with a body that is made of the clip's own skeleton; for a table, with the robot's.
[[nodiscard]] Result<PlayedClip> loadClipAlone(const ClipRequest& request);

/// Tolerated faults, joints without a match and signs of a wrong unit: one sentence each, bounded
/// in number.
[[nodiscard]] std::vector<std::string> remarksOnClip(const Avatar& avatar, const Clip& clip,
                                                     const JointMatch& match,
                                                     const std::string& avatarPath,
                                                     const std::string& motionPath);

/// Links without any LSS: all of a robot's; a body's only if they are half of all links, as its
/// root and its tips have none anyway.
[[nodiscard]] std::optional<std::string> remarkOnVolume(const Avatar& avatar,
                                                        const std::string& avatarPath,
                                                        bool isRobot);

/// Only the last of these: the clip's bones are over twice as long as the avatar's, or under half.
[[nodiscard]] std::optional<std::string> remarkOnUnit(const Avatar& avatar, const Clip& clip,
                                                      const JointMatch& match,
                                                      const std::string& motionPath);

/// "'a', 'b' and 7 more": the first of many names.
[[nodiscard]] std::string firstOf(const std::vector<std::string>& names);

}  // namespace foretouch::tools
