// tools/feet/feet_inputs.h: a clip, its body and what it stands on, ready for questions on how feet
// rest. World W: metres, +Y up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/result.h"
#include "tools/floor/floor_fit.h"
#include "tools/floor/resting_body.h"
#include "tools/inputs/played_clip.h"
#include "tools/settings/world_settings.h"
#include "tools/setup/level.h"

namespace foretouch::tools {

/// Cosine of the steepest ground, 45 degrees: what character controllers take as walkable.
inline constexpr double kWalkableUp = 0.7;

/// Where the ground is.
enum class GroundFrom : std::uint8_t {
  Given,  ///< Where the clip, its placement and the scene have it.
  Fit,    ///< Where the feet rest: the clip is moved until its own floor lies on the ground.
};

struct FeetRequest : ClipRequest, WorldRequest {
  GroundFrom ground = GroundFrom::Given;
  /// A part touches within this distance (m): hovering begins beyond it.
  double tolerance = 0.005;
  std::vector<std::string> feet;  ///< Links that are feet; empty: those that are called so.

  /// True if the body is made of a BVH clip's bones.
  [[nodiscard]] bool isMadeOfBones() const { return avatarPath.empty() && robotPath.empty(); }
  /// The file whose names the body's links have.
  [[nodiscard]] const std::string& bodyPath() const {
    if (!avatarPath.empty()) return avatarPath;
    return robotPath.empty() ? motionPath : robotPath;
  }
};

/// What is this near to a plane (m) is on it.
inline constexpr double kSameSurface = 0.01;

/// A surface to stand on, flat around the point of the question.
struct GroundSurface {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitY();  ///< Unit, up.

  [[nodiscard]] double heightOf(const Eigen::Vector3d& p) const { return normal_W.dot(p - p_W); }
};

struct FeetInputs {
  FeetRequest request;
  PlayedClip played;
  RestingBody body;
  Level level;  ///< The scene; without one, a floor at y = 0.
  bool isPlain = false;
  std::size_t heelsMade = 0;     ///< For a body that is made of bones (tools/floor/heels.h).
  std::size_t heelsMissing = 0;  ///< For an avatar that was given: bones without a heel below them.
  std::optional<FloorFit> fit;   ///< For GroundFrom::Fit.
  double fitShift = 0.0;         ///< How far the fit raised the clip, at the fit's middle (m).
  Eigen::Isometry3d correction = Eigen::Isometry3d::Identity();  ///< The fit's motion of W.
  bool keepsLooks = false;  ///< Stances keep where they were looked at (FootStance::looks).

  [[nodiscard]] std::int64_t steps() const { return played.steps.count; }
  [[nodiscard]] double stepS() const {
    return static_cast<double>(played.steps.stride) * played.clip.frameTimeS;
  }
  [[nodiscard]] double timeOf(std::int64_t step) const {
    return static_cast<double>(played.steps.frameOf(step)) * played.clip.frameTimeS;
  }
  /// A pose of body.avatar, where the fit has it.
  [[nodiscard]] Result<Pose> poseAt(std::int64_t step) const;
  /// What `p_W` stands on, or sank through by at most a quarter of a metre; nothing: a void.
  [[nodiscard]] std::optional<GroundSurface> groundBelow(const Eigen::Vector3d& p_W) const;
  /// The same for a point of a foot. A foot below a table top or board that none of its bones goes
  /// through did not sink through it: the ground is the next surface below. `states`: those of
  /// body.avatar, or of the one that it is made of.
  [[nodiscard]] std::optional<GroundSurface> groundOf(const RestingLimb& limb,
                                                      const std::vector<LinkState>& states,
                                                      const Eigen::Vector3d& p_W) const;
};

/// Errors name the file or the option; with GroundFrom::Fit, also those of fitFloor().
[[nodiscard]] Result<FeetInputs> loadFeetInputs(const FeetRequest& request);

/// A doubt if the body is not of a person's size, with the unit in which it would be.
[[nodiscard]] std::optional<std::string> doubtOfStature(const FeetInputs& inputs);
/// The remarks of remarksOnClip(), and what the body is.
[[nodiscard]] std::vector<std::string> remarksOn(const FeetInputs& inputs);

}  // namespace foretouch::tools
