// tools/inputs/replay_inputs.h: what a replay is asked for, and the checked inputs it then works
// on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/inputs/step_selection.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

/// What is asked of a recorded clip: what is played, and the world that it is played in.
struct ReplayRequest : ClipRequest, WorldRequest {};

struct ReplayInputs {
  ReplayRequest request;
  Scene scene;
  Avatar avatar;
  Clip clip;
  JointMatch match;
  StepSelection steps;
  QueryOptions query;      ///< As asked, with what the avatar and the scene add to it.
  bool isUpright = false;  ///< The clip was turned Y-up as it was read (Motion::isUpright).

  [[nodiscard]] double timeOfStep(std::int64_t step) const {
    return static_cast<double>(step * steps.stride) * clip.frameTimeS;
  }
};

/// Reads, checks and fits the inputs to one another. Errors name the file or option.
[[nodiscard]] Result<ReplayInputs> loadReplayInputs(const ReplayRequest& request);

/// The scene that the request names, and nothing else of it.
[[nodiscard]] Result<Scene> loadScene(const WorldRequest& request);

/// The options of queries about the avatar, which was read from `avatarPath`, with the surface or
/// skin that its fidelity asks for. Where policies ask for exact links, only these links' meshes
/// are read, and what queries need of each is built when the first of them comes near anything.
[[nodiscard]] Result<QueryOptions> queryOptionsFor(const WorldRequest& request,
                                                   const std::string& avatarPath,
                                                   const Avatar& avatar, const Scene& scene);

/// What the reader tolerated, what did not match and what looks like a wrong unit: one sentence
/// each, bounded in number.
[[nodiscard]] std::vector<std::string> remarksOn(const ReplayInputs& inputs);

/// The avatar in the pose of a frame, where the placement puts it. Error where that is farther out
/// than coordinates may be. `frame` is within the clip.
[[nodiscard]] Result<Pose> poseAtFrame(const ReplayInputs& inputs, std::int64_t frame);

}  // namespace foretouch::tools
