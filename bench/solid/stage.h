// bench/solid/stage.h: where a solid avatar is measured: real scenes and clips, in the product's
// form and in the judge's.
#pragma once

#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "bench/solid/plain_body.h"
#include "judge/scene.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

struct SolidStage {
  std::string name;
  Scene scene;
  oracle::Scene judged;  ///< Its finite triangles.
};

/// A person of kActorHeight, made of a clip.
struct SolidActor {
  std::string name;
  Avatar avatar;
  Clip clip;
  double lowestM = 0.0;  ///< The lowest point of all LSS over the whole clip.
};
/// The largest side of the rest skeleton (m).
inline constexpr double kActorHeight = 1.65;

[[nodiscard]] SolidStage stageOf(std::string name, RawScene raw);
/// Errors name the file. What the file says about its own axes counts before `upZ`.
[[nodiscard]] Result<SolidStage> loadStage(const std::string& name, const std::string& path,
                                           bool isUpZ);
/// Errors name the file; Empty if it has fewer than two frames or no extent.
[[nodiscard]] Result<SolidActor> loadActor(const std::string& path);

/// The clip's poses at `place`, `rateHz` of them per second from `fromS` on for `seconds`, in
/// between frames by the in-between motion. Stops where the clip ends.
[[nodiscard]] std::vector<Pose> trackedPoses(const SolidActor& actor, const Placement& place,
                                             double rateHz, double fromS, double seconds);

/// What the names of an avatar's links say they are.
struct SolidLinks {
  std::vector<bool> hands, heads, trunk;  ///< One per link; the trunk holds the head.
};
[[nodiscard]] SolidLinks solidLinks(const Avatar& avatar);

}  // namespace foretouch::tools
