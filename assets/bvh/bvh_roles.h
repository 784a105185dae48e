// assets/bvh/bvh_roles.h: the part of a body that a joint's name means. Internal to bvh_avatar.
#pragma once

#include <vector>

#include "articulated/skeleton.h"

namespace foretouch::internal {

/// The part of the body that moves with a joint, from it towards its children.
enum class BodyRole {
  Unknown,
  Root,  ///< Carries the body but is not part of it ("Root" above "Hips").
  Pelvis,
  Torso,
  Neck,
  Head,
  Clavicle,
  UpperArm,
  Forearm,
  Hand,
  Finger,
  Thigh,
  Shin,
  Foot,
  Toe,
};

/// One role per joint, from its name (in the schemes of MotionBuilder, Biovision, Mixamo, Bandai
/// and MakeHuman, any case) and, if a word has two meanings, from its children's names. For a
/// humanoid (assets/human_bones.h) only VRM's names count; others are Unknown, or carry the hips.
[[nodiscard]] std::vector<BodyRole> bodyRoles(const Skeleton& skeleton);

/// A bone by the roles of the joints at its ends.
struct RoleBone {
  BodyRole role = BodyRole::Unknown;
  BodyRole next = BodyRole::Unknown;  ///< Unknown if the bone is a tip.
  bool isTip = false;                 ///< It ends at no joint.
  double length = 0.0;
};

/// The mean of all legs.
struct Legs {
  int knees = 0, ankles = 0;
  double length = 0.0;  ///< Hip to ankle; 0 without knees.
};
[[nodiscard]] Legs legsOf(const std::vector<RoleBone>& bones);

/// Thigh and shank; [Winter09] 0.491, [DeLeva96] 0.492 (docs/formats.md).
inline constexpr double kLegPerStature = 0.49;

/// The role's radius as a fraction of stature (docs/formats.md); 0 for Unknown and Root.
[[nodiscard]] double radiusPerStature(BodyRole role);

}  // namespace foretouch::internal
