// tools/inputs/replay_inputs.h: a replay's request, and the checked inputs made from it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/inputs/apart_meshes.h"
#include "tools/inputs/pose_curve.h"
#include "tools/inputs/step_selection.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

/// A recorded clip to play, and the world to play it in.
struct ReplayRequest : ClipRequest, WorldRequest {
  /// What the avatar is taken to do between two poses, where the answers are about that model.
  MotionModel between = MotionModel::ConstantRate;
};

struct ReplayInputs {
  ReplayRequest request;  ///< With the units and axes that the files were read with.
  Scene scene;
  Avatar avatar;
  Clip clip;
  JointMatch match;
  StepSelection steps;
  QueryOptions query;      ///< As requested, completed from the avatar and the scene.
  bool isUpright = false;  ///< The reader turned the clip Y-up (Motion::isUpright).
  FileFrame sceneFrame{}, clipFrame{};
  /// The poses that are played, where they are not the clip's: `steps` and the clip's frame time
  /// are those of its pieces.
  std::optional<PoseCurve> curve = std::nullopt;

  [[nodiscard]] double timeOfStep(std::int64_t step) const {
    return static_cast<double>(steps.frameOf(step)) * clip.frameTimeS;
  }
  /// For a table of joint positions: the row, from 0, that the step begins at, or comes from.
  [[nodiscard]] std::int64_t rowOfStep(std::int64_t step) const {
    return steps.frameOf(step) / clip.framesPerRow;
  }
};

/// Reads, checks and matches the inputs. Errors name the file or option.
[[nodiscard]] Result<ReplayInputs> loadReplayInputs(const ReplayRequest& request);

/// Loads only the request's scene; `frame` becomes that of its file.
[[nodiscard]] Result<Scene> loadScene(const WorldRequest& request, FileFrame& frame);
[[nodiscard]] Result<Scene> loadScene(const WorldRequest& request);

/// The options of queries about the avatar, which was read from `avatarPath`, with the surface or
/// skin that its fidelity needs. If policies make only some links exact, reads only those links'
/// meshes; the first query that brings a link near anything builds its hierarchy.
[[nodiscard]] Result<QueryOptions> queryOptionsFor(const WorldRequest& request,
                                                   const std::string& avatarPath,
                                                   const Avatar& avatar, const Scene& scene);

/// Says so if exact fidelity is no more than link fidelity here because no link has a mesh.
[[nodiscard]] std::optional<std::string> remarkOnMeshes(const QueryOptions& query,
                                                        const std::string& avatarPath);

/// Tolerated faults, joints without a match and signs of a wrong unit: one sentence each, bounded
/// in number.
[[nodiscard]] std::vector<std::string> remarksOn(const ReplayInputs& inputs);

/// Own links that start in contact in nearly all of the steps that were answered, at link fidelity:
/// which of them only their LSS make touch, and how to leave them out. Reads their meshes.
[[nodiscard]] std::optional<std::string> hintOnOwnPairs(const ReplayInputs& inputs,
                                                        const std::vector<StartingPair>& pairs,
                                                        std::int64_t steps);

/// The avatar's placed pose at a frame. Error if it lies beyond the limit of coordinates. `frame`
/// is within the clip.
[[nodiscard]] Result<Pose> poseAtFrame(const ReplayInputs& inputs, std::int64_t frame);

}  // namespace foretouch::tools
