// tools/settings/clip_settings.h: the clip to play, how to read it, and its placement: for every
// command that plays one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/avatar/joint_match.h"
#include "assets/file_frame.h"
#include "assets/model/model.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// An instant of a clip: seconds, or a frame counted from 0.
struct ClipInstant {
  double number = 0.0;  ///< Finite, at least 0; whole if it is a frame.
  bool isFrame = false;
};

/// Which part of a clip is played.
struct ClipCut {
  std::optional<ClipInstant> from, to;  ///< Empty: its begin, its end.
  bool skipsTPose = false;              ///< Leaves out the T-pose that it begins with.
};

/// Each setting is legal by itself. Paths are ready to open.
struct ClipRequest {
  std::string avatarPath, motionPath;
  std::string mapPath;                    ///< Empty: matches joints by name alone.
  std::optional<double> rateHz;           ///< Empty: every frame.
  std::optional<double> motionScale;      ///< Metres per unit, in place of what the clip says.
  std::optional<UpAxis> motionUp;         ///< In place of what the clip says.
  std::string animation;                  ///< For a motion that is a model.
  std::string robotPath;                  ///< For a motion that is a table of joint positions.
  std::string skeletonPath;               ///< For a motion in AMC, or of SMPL.
  std::vector<std::string> packagePaths;  ///< Folders of that robot's packages.
  JointTableOptions table;                ///< What that table does not say itself.
  Placement placement;                    ///< The option sets its motionUpZ too, for BVH.
  ClipCut cut;                            ///< For commands that have addCutSettings().
};

/// What readMotion() reads, for a shell that completes files.
inline constexpr char kClipEndings[] = "bvh amc mvnx glb gltf fbx dae x csv npz json";
inline constexpr char kClipHelp[] =
    "Clip (bvh, amc, mvnx), animated model (glb, gltf, fbx, dae, x), joint positions (csv, npz), "
    "motion of SMPL (npz) or session of WebXR (json)";

/// "x,y,z" or "x,y,z,yaw": metres within kMaxCoordinate, and degrees. Errors name no option.
[[nodiscard]] Result<Placement> placementFrom(const std::string& text);
/// --place; `place` keeps its motionUpZ.
Setting& addPlaceSetting(Settings& settings, Placement& place, const char* help);

/// The motion itself; `option`: its option.
Setting& addMotionSetting(Settings& settings, ClipRequest& request, const char* option,
                          const char* value, const char* help = kClipHelp);

/// --avatar.
Setting& addAvatarSetting(Settings& settings, ClipRequest& request);

/// --rate; `help` says what the command does with the selected poses.
Setting& addRateSetting(
    Settings& settings, ClipRequest& request,
    const char* help = "Poses per second to take from the clip; animations: 30 if all");

/// How to read the motion and match it with the avatar: --clip-scale, --clip-up, --animation,
/// --robot, those of a robot's table, --map and --package. `request` outlives the settings.
void addClipReadingSettings(Settings& settings, ClipRequest& request);
/// The same, and its placement: --place.
void addClipSettings(Settings& settings, ClipRequest& request);

/// "2.5" seconds, or "300f": a frame. Errors name no option.
[[nodiscard]] Result<ClipInstant> clipInstantFrom(const std::string& text);
/// Adds the settings for the part of the clip: --from, --to, --skip-t-pose.
void addCutSettings(Settings& settings, ClipRequest& request);
Setting& addSkipTPose(Settings& settings, ClipRequest& request);

}  // namespace foretouch::tools
