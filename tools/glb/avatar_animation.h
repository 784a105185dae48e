// tools/glb/avatar_animation.h: the in-between motion (articulated/motion.h) as the keys of a glTF
// animation. glTF's LINEAR is slerp on the shorter arc for rotations and linear for translations,
// which is that motion; the code must ensure that rounding to floats does not change the arc.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "tools/glb/glb_content.h"

namespace foretouch::tools {

/// The rotations of one joint, each negated if needed so that its dot product with the one before
/// is not negative.
struct RotationKeys {
  std::vector<Quaternion> values;
  /// A step's turn is so near half a turn that floats could choose the other arc: there is an extra
  /// key midway between two poses.
  bool haveMiddles = false;
  bool areConstant = false;
};

[[nodiscard]] RotationKeys rotationKeys(const std::vector<Pose>& poses, JointId joint);

/// An animation under construction.
class GlbAnimation {
 public:
  explicit GlbAnimation(const char* name) : entry_{{"name", name}} {}

  /// `path` is glTF's ("rotation", ...), `input` and `output` are accessors.
  void add(std::size_t node, const char* path, std::size_t input, std::size_t output,
           const char* interpolation);
  /// Adds the animation to the document if it moves anything.
  void finish(GltfDocument& document);

 private:
  nlohmann::json entry_;
  std::size_t samplers_ = 0;
};

/// Poses and their times.
struct AvatarTrack {
  const Skeleton& skeleton;
  const std::vector<Pose>& poses;  ///< At least two.
  std::vector<double> timesS;      ///< One per pose.
};

/// Error if times are so close, or so late, that floats cannot distinguish them.
[[nodiscard]] Result<Done> checkTimes(const std::vector<double>& timesS);

/// Adds one node per link, with its name, in the first pose; roots become children of `parent`,
/// whose origin is at `origin` in the world, and the animation moves them. `meshes` has one per
/// link, kNoMesh for none. Returns the first link's node; the others follow in order.
inline constexpr std::size_t kNoMesh = static_cast<std::size_t>(-1);
std::size_t addAvatar(const AvatarTrack& track, const std::vector<std::size_t>& meshes,
                      std::size_t parent, const Eigen::Vector3d& origin, GlbContent& content,
                      GlbAnimation& animation);

}  // namespace foretouch::tools
