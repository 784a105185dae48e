// tools/inputs/motion_file.h: clips from whatever file holds one: BVH, an animated model, or a
// table of a robot's joint positions. The file's extension decides (docs/formats.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxJointTableBytes = std::size_t{256} << 20;

struct MotionRequest {
  std::string path;
  double scale = 1.0;                     ///< Metres per unit of the file.
  UpAxis up = UpAxis::Y;                  ///< Of the file. Tables of joint positions do not ask.
  std::string animation;                  ///< Of a model; empty: its first.
  double rateHz = 30.0;                   ///< That a model's animation is sampled at.
  std::string robot;                      ///< The URDF whose joints a table is about.
  std::vector<std::string> packagePaths;  ///< Where that URDF's packages are.
};

/// The motion of a command that plays a clip.
[[nodiscard]] MotionRequest motionRequestOf(const ClipRequest& request);

struct Motion {
  Clip clip;
  /// Z-up has been turned in. Models turn their roots as they are read, so that a joint that the
  /// clip leaves at rest stands as the avatar of the same model does; BVH clips are turned by their
  /// placement.
  bool isUpright = false;
};

/// Errors name the file or the option.
[[nodiscard]] Result<Motion> readMotion(const MotionRequest& request);

}  // namespace foretouch::tools
