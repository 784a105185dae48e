// tests/oracle/sweep_inputs.h: real clips and scenes, each in the product's form and in the
// oracle's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "judge/judge.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tests/support/judged_answer.h"

namespace foretouch::test {

struct SweepClip {
  std::string name;
  double scale =
      1.0;  ///< Metres per file unit, chosen so that the rest skeleton is a person's size.
  Clip clip;
  Avatar avatar;
  std::vector<std::vector<oracle::Capsule>> capsules;  ///< Per link.
  /// For models: queries use exact fidelity, judged by the triangles of each link.
  std::optional<AvatarSurface> surface;
  std::vector<std::vector<oracle::Triangle>> meshes;
  /// The same triangles as a skin, for skinned fidelity.
  std::optional<SkinnedSurface> skin;
  std::vector<std::vector<oracle::SkinTriangle>> skins;
  // Of the unplaced clip: the place of its middle frame, and its lowest joint over all frames.
  Eigen::Vector3d standsAt = Eigen::Vector3d::Zero();
  double lowest = 0.0;

  [[nodiscard]] int numSteps(int stride) const {
    return (static_cast<int>(clip.frames.size()) - 1) / stride;
  }
};

/// Frames from one step to the next: `replay --rate` keeps every k-th frame likewise.
[[nodiscard]] int strideFor(const Clip& clip, double rateHz);

/// Reads the clip (or a rigged model and its first animation, at 30 Hz) at the scale that makes the
/// rest skeleton's largest extent 1.7 m. Error if it is unreadable or has fewer than two frames.
[[nodiscard]] Result<SweepClip> loadClip(const std::string& path);

struct SweepScene {
  std::string name;
  Scene scene;
  oracle::Scene oracle;  ///< The importer's triangles, same numbering.
};

/// The scenes that the sweep knows by name, with their files and up axes.
[[nodiscard]] std::vector<std::string> sceneNames();
/// One triangle out of every clip's reach: for questions about own links alone.
[[nodiscard]] SweepScene emptySurroundings();
[[nodiscard]] Result<SweepScene> loadScene(const std::string& name, const std::string& dataFolder);

/// Every BVH file's path in data/mocap, sorted.
[[nodiscard]] std::vector<std::string> clipPaths(const std::string& dataFolder);

/// The placement of a clip: turned about +Y, then moved. Metres, radians.
struct Placement {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0;
  double contactRate = 0.0;  ///< Share of probed steps with a contact that does not start in
                             ///< contact.
};
[[nodiscard]] Pose placed(const Skeleton& skeleton, const Pose& pose, const Placement& placement);

}  // namespace foretouch::test
