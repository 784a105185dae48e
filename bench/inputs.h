// bench/inputs.h: the scene, avatar and clip of a benchmark, from their files.
#pragma once

#include <string>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/scene_import.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

struct BenchFiles {
  std::string scenePath;   ///< Empty: the bundled room.
  std::string motionPath;  ///< Empty: the bundled clip.
  std::string avatarPath;  ///< Empty: the bundled avatar for the bundled clip, else
                           ///< avatarFromClip() of the clip.
  std::string mapPath;
  double sceneScale = 1.0, motionScale = 1.0;  ///< Metres per unit.
  UpAxis sceneUp = UpAxis::Y, motionUp = UpAxis::Y;
};

struct BenchInputs {
  BenchFiles files;  ///< With the bundled paths filled in.
  RawScene raw;
  Scene scene;
  Avatar avatar;
  Clip clip;
  JointMatch match;
  bool isUpright = false;  ///< As in Motion::isUpright.
};

/// 1 and Y, the options' defaults, ask for nothing: what a file says about itself then counts.
[[nodiscard]] SceneImportOptions importOf(double scale, UpAxis up);

/// Errors name the file.
[[nodiscard]] Result<BenchInputs> loadBenchInputs(BenchFiles files);

/// The avatar's placed pose at a frame, not validated.
[[nodiscard]] Pose placedPose(const BenchInputs& inputs, const Placement& placement,
                              std::int64_t frame);

}  // namespace foretouch::tools
