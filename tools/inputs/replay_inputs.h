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
#include "assets/import/scene_import.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/inputs/policy_rules.h"
#include "tools/inputs/step_selection.h"

namespace foretouch::tools {

/// The options of a replay, each legal by itself.
struct ReplayRequest {
  std::string scenePath, avatarPath, motionPath;
  std::string mapPath;           ///< Empty: joints are matched by name alone.
  std::optional<double> rateHz;  ///< Empty: every frame.
  double motionScale = 1.0;      ///< Metres per unit of the clip.
  std::string animation;         ///< Of a motion that is a model.
  std::string robotPath;         ///< Of a motion that is a table of joint positions.
  std::vector<std::string> packagePaths;
  double sceneScale = 1.0;  ///< Metres per unit of the scene.
  UpAxis sceneUp = UpAxis::Y;
  Placement placement;
  double tolerance = 1e-3;
  Culler culler = Culler::FlatBvh;
  Fidelity fidelity = Fidelity::Link;
  LeafMethod leafMethod = LeafMethod::Advancement;
  Scope scope = Scope::EveryLink;
  std::string skinPath;    ///< The model whose skin is the surface at skinned fidelity.
  double skinScale = 1.0;  ///< Metres per unit of that model.
  UpAxis skinUp = UpAxis::Y;
  std::vector<std::string> ignore;
  std::string policyPath;
  std::vector<PolicyRule> policies;  ///< Of that file, or of a service's; later ones win.
  /// What a step's query may cost, as workBudget() makes work of it; 0: no limit.
  std::int64_t budgetUs = 0;
};

struct ReplayInputs {
  ReplayRequest request;
  Scene scene;
  Avatar avatar;
  Clip clip;
  JointMatch match;
  StepSelection steps;
  QueryOptions query;
  bool isUpright = false;  ///< The clip was turned Y-up as it was read (Motion::isUpright).

  [[nodiscard]] double timeOfStep(std::int64_t step) const {
    return static_cast<double>(step * steps.stride) * clip.frameTimeS;
  }
};

/// Reads, checks and fits the inputs to one another. Errors name the file or option.
[[nodiscard]] Result<ReplayInputs> loadReplayInputs(const ReplayRequest& request);

/// The scene that the request names, and nothing else of it.
[[nodiscard]] Result<Scene> loadScene(const ReplayRequest& request);

/// The options of its queries, with the surface or skin that its fidelity asks for. Where policies
/// ask for exact links, only these links' meshes are read, and what queries need of each is built
/// when the first of them comes near anything.
[[nodiscard]] Result<QueryOptions> queryOptionsFor(const ReplayRequest& request,
                                                   const Avatar& avatar, const Scene& scene);

/// What the reader tolerated, what did not match and what looks like a wrong unit: one sentence
/// each, bounded in number.
[[nodiscard]] std::vector<std::string> remarksOn(const ReplayInputs& inputs);

/// The avatar in the pose of a frame, where the placement puts it. Error where that is farther out
/// than coordinates may be. `frame` is within the clip.
[[nodiscard]] Result<Pose> poseAtFrame(const ReplayInputs& inputs, std::int64_t frame);

}  // namespace foretouch::tools
