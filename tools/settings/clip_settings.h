// tools/settings/clip_settings.h: which clip is played, how it is read, and where it stands: for
// every command that plays one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/avatar/joint_match.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// Each setting legal by itself. Paths can be opened as they are.
struct ClipRequest {
  std::string avatarPath, motionPath;
  std::string mapPath;                    ///< Empty: joints are matched by name alone.
  std::optional<double> rateHz;           ///< Empty: every frame.
  double motionScale = 1.0;               ///< Metres per unit of the clip.
  std::string animation;                  ///< Of a motion that is a model.
  std::string robotPath;                  ///< Of a motion that is a table of joint positions.
  std::vector<std::string> packagePaths;  ///< Where that robot's packages are.
  Placement placement;
};

inline constexpr char kClipHelp[] =
    "BVH clip, animated model (glb, gltf, fbx, dae, x) or joint positions (csv)";

/// The motion itself; `option`: how it is given.
Setting& addMotionSetting(Settings& settings, ClipRequest& request, const char* option,
                          const char* value, const char* help = kClipHelp);

/// --avatar, where there is one.
Setting& addAvatarSetting(Settings& settings, ClipRequest& request);

/// --rate; `help` says what is done with the poses that are kept.
Setting& addRateSetting(
    Settings& settings, ClipRequest& request,
    const char* help = "Poses per second to take from the clip; animations: 30 if all");

/// How the motion is read, and matched with the avatar: --scale, --motion-up, --animation, --robot,
/// --map and --package. `request` outlives the settings.
void addClipReadingSettings(Settings& settings, ClipRequest& request);
/// The same, and where it stands: --place.
void addClipSettings(Settings& settings, ClipRequest& request);

}  // namespace foretouch::tools
