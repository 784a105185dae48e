// tools/glb/avatar_animation.h: the in-between motion (articulated/motion.h) as the keys of a glTF
// animation. glTF's LINEAR is slerp on the shorter arc for rotations and linear for translations,
// which is that motion; what has to be seen to is that floats leave the arc as it is.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "articulated/avatar.h"
#include "articulated/pose.h"
#include "articulated/result.h"
#include "tools/glb/glb_content.h"

namespace foretouch::tools {

/// The rotation of one joint, each the negative of what the pose says where it takes that to make
/// the dot product with the one before not negative.
struct RotationKeys {
  std::vector<Quaternion> values;
  /// A turn of a step is so near half a turn that floats could choose the other arc: between two
  /// poses there is a key more, at the middle.
  bool haveMiddles = false;
  bool areConstant = false;
};

[[nodiscard]] RotationKeys rotationKeys(const std::vector<Pose>& poses, JointId joint);

/// An animation in the making.
class GlbAnimation {
 public:
  explicit GlbAnimation(const char* name) : entry_{{"name", name}} {}

  /// `path` is glTF's ("rotation", ...), `input` and `output` are accessors.
  void add(std::size_t node, const char* path, std::size_t input, std::size_t output,
           const char* interpolation);
  /// Adds it to the document where it moves anything.
  void finish(GltfDocument& document);

 private:
  nlohmann::json entry_;
  std::size_t samplers_ = 0;
};

/// Poses and when they are.
struct AvatarTrack {
  const Avatar& avatar;
  const std::vector<Pose>& poses;  ///< At least two.
  std::vector<double> timesS;      ///< One a pose.
};

/// Error where times are so close, or so late, that floats do not tell them apart.
[[nodiscard]] Result<Done> checkTimes(const std::vector<double>& timesS);

/// Adds a node a link, named as it is, in the first pose; roots become children of `parent`, whose
/// origin is at `origin` in the world, and the animation moves them. `meshes` has one a link:
/// kNoMesh where there is none. Returns the first link's node; the others follow in order.
inline constexpr std::size_t kNoMesh = static_cast<std::size_t>(-1);
std::size_t addAvatar(const AvatarTrack& track, const std::vector<std::size_t>& meshes,
                      std::size_t parent, const Eigen::Vector3d& origin, GlbContent& content,
                      GlbAnimation& animation);

}  // namespace foretouch::tools
