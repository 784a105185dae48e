// tools/inputs/played_clip.h: a clip and the avatar that it moves, read and fitted to one another:
// what every command that plays a clip begins with.
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
  bool isUpright = false;  ///< As Motion::isUpright.
};

/// `rateHz` as selectSteps() takes it. Errors name the file or option.
[[nodiscard]] Result<PlayedClip> loadPlayedClip(const std::string& avatarPath,
                                                const MotionRequest& motion,
                                                const std::string& mapPath,
                                                std::optional<double> rateHz);

/// The same for the options of a command (ReplayRequest, SweepRequest, PublishRequest).
template <typename Request>
[[nodiscard]] Result<PlayedClip> loadPlayedClip(const Request& request) {
  return loadPlayedClip(request.avatarPath, motionRequestOf(request), request.mapPath,
                        request.rateHz);
}

/// What the reader tolerated, what did not match and what looks like a wrong unit: one sentence
/// each, bounded in number.
[[nodiscard]] std::vector<std::string> remarksOnClip(const Avatar& avatar, const Clip& clip,
                                                     const JointMatch& match,
                                                     const std::string& avatarPath,
                                                     const std::string& motionPath);

/// The last of them alone: bones of the clip that are twice as long as the avatar's, or half.
[[nodiscard]] std::optional<std::string> remarkOnUnit(const Avatar& avatar, const Clip& clip,
                                                      const JointMatch& match,
                                                      const std::string& motionPath);

/// "'a', 'b' and 7 more": the first of many names.
[[nodiscard]] std::string firstOf(const std::vector<std::string>& names);

}  // namespace foretouch::tools
