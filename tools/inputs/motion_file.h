// tools/inputs/motion_file.h: reads the clip that a command's options name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/clip/clip_file.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {

struct MotionRequest {
  std::string path;
  std::optional<double> scale;            ///< Metres per unit, in place of what the file says.
  std::optional<UpAxis> up;               ///< Up, likewise. Tables of joint positions ignore it.
  std::string animation;                  ///< A model's animation; empty: its first.
  double rateHz = 30.0;                   ///< Sampling rate of a model's animation.
  std::string robot;                      ///< The URDF whose joints a table is about.
  std::string skeleton;                   ///< The ASF of an AMC, or SMPL's body model.
  std::vector<std::string> packagePaths;  ///< Folders of that URDF's packages.
  JointTableOptions table;                ///< What that table does not say itself.
};

/// The motion of a command that plays a clip.
[[nodiscard]] MotionRequest motionRequestOf(const ClipRequest& request);

/// The same as the readers of files take it.
[[nodiscard]] ClipFileOptions clipFileOptionsOf(const MotionRequest& request);

using Motion = ClipFile;

/// Errors name the file or the option.
[[nodiscard]] Result<Motion> readMotion(const MotionRequest& request);

}  // namespace foretouch::tools
