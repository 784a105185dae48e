// assets/bvh/bvh_roles.h: which part of a body a joint's name stands for. Internal to bvh_avatar.
#pragma once

#include <vector>

#include "articulated/skeleton.h"

namespace foretouch::internal {

/// The part of the body that moves with a joint, from it towards its children.
enum class BodyRole {
  Unknown,
  Root,  ///< Carries the body and is no part of it ("Root" above "Hips").
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

/// One role per joint, told from its name (in the schemes of MotionBuilder, Biovision, Mixamo,
/// Bandai and MakeHuman, any case) and, where a word has two meanings, from its children's names.
[[nodiscard]] std::vector<BodyRole> bodyRoles(const Skeleton& skeleton);

/// The role's radius as a fraction of stature (docs/formats.md); 0 for Unknown and Root.
[[nodiscard]] double radiusPerStature(BodyRole role);

}  // namespace foretouch::internal
