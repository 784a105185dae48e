// tools/inputs/motion_file.h: reads clips from BVH, an animated model, or a table of a robot's
// joint positions. The file's extension decides (docs/formats.md).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxJointTableBytes = std::size_t{256} << 20;

/// What the file's extension says that it is. Every file that is neither a table nor a model format
/// with animations counts as BVH, whose reader gives the best error.
enum class MotionKind { Bvh, Model, Table };
[[nodiscard]] MotionKind motionKindOf(const std::string& path);

struct MotionRequest {
  std::string path;
  std::optional<double> scale;            ///< Metres per unit, in place of what the file says.
  std::optional<UpAxis> up;               ///< The same. Tables of joint positions ignore it.
  std::string animation;                  ///< Of a model; empty: its first.
  double rateHz = 30.0;                   ///< Sampling rate of a model's animation.
  std::string robot;                      ///< The URDF whose joints a table is about.
  std::vector<std::string> packagePaths;  ///< Folders of that URDF's packages.
};

/// The motion of a command that plays a clip.
[[nodiscard]] MotionRequest motionRequestOf(const ClipRequest& request);

struct Motion {
  Clip clip;
  /// True: already turned from Z-up. The reader of models turns their roots, so that a joint that
  /// the clip leaves at rest matches the avatar of the same model; the placement turns BVH clips.
  bool isUpright = false;
  FileFrame frame;  ///< Of BVH, which says nothing of itself: as asked.
};

/// Errors name the file or the option.
[[nodiscard]] Result<Motion> readMotion(const MotionRequest& request);

}  // namespace foretouch::tools
