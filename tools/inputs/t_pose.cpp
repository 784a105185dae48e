#include "tools/inputs/t_pose.h"

#include <cmath>
#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "assets/bvh/bvh_roles.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using internal::BodyRole;

/// An arm that is this much of its bones' length is straight, one that rises by less than this is
/// level, and two that differ from opposite by less than this point away from each other (cosines
/// of 20 and 30 degrees). A person who walks or dances holds both arms so for no longer than a
/// gesture; twice as wide, and dancers stand in T-poses.
constexpr double kStraight = 0.95, kMostRise = 0.342, kOpposite = -0.866;

/// The joints of one arm, from the hand up to the shoulder.
using Arm = std::vector<JointId>;

/// The arm's joints; nothing if what is above the hand is not an arm.
std::optional<Arm> armAbove(JointId hand, const Skeleton& skeleton,
                            const std::vector<BodyRole>& roles) {
  Arm arm{hand};
  const auto roleOf = [&](JointId joint) {
    return joint == kNoParent ? BodyRole::Unknown : roles[slotOf(joint)];
  };
  JointId joint = skeleton.parent(hand);
  while (roleOf(joint) == BodyRole::Forearm || roleOf(joint) == BodyRole::UpperArm) {
    arm.push_back(joint);
    joint = skeleton.parent(joint);
  }
  const bool isWhole = arm.size() > 2 && roleOf(arm.back()) == BodyRole::UpperArm;
  return isWhole ? std::optional<Arm>(arm) : std::nullopt;
}

std::vector<Arm> armsOf(const Skeleton& skeleton) {
  const std::vector<BodyRole> roles = internal::bodyRoles(skeleton);
  std::vector<Arm> arms;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    if (roles[slotOf(joint)] != BodyRole::Hand) continue;
    const auto arm = armAbove(joint, skeleton, roles);
    if (arm) arms.push_back(*arm);
  }
  return arms;
}

/// Unit, from the shoulder to the hand; nothing if the arm is bent.
std::optional<Vector3d> directionOf(const Arm& arm, const std::vector<LinkState>& states) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < arm.size(); ++i) {
    length += (states[slotOf(arm[i])].p_WL - states[slotOf(arm[i + 1])].p_WL).norm();
  }
  const Vector3d way = states[slotOf(arm.front())].p_WL - states[slotOf(arm.back())].p_WL;
  if (!(length > 0.0) || way.norm() < kStraight * length) return std::nullopt;
  return way.normalized();
}

bool isTPose(const std::vector<Arm>& arms, const std::vector<LinkState>& states, bool isZUp) {
  const auto left = directionOf(arms[0], states), right = directionOf(arms[1], states);
  if (!left || !right || left->dot(*right) > kOpposite) return false;
  const auto riseOf = [&](const Vector3d& way) { return std::abs(isZUp ? way.z() : way.y()); };
  return riseOf(*left) <= kMostRise && riseOf(*right) <= kMostRise;
}

}  // namespace

std::int64_t tPoseFramesOf(const Clip& clip, bool isZUp) {
  const std::vector<Arm> arms = armsOf(clip.skeleton);
  if (arms.size() != 2) return 0;
  std::vector<LinkState> states;
  for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
    const Pose& pose = clip.frames[frame];
    ChainMotion(clip.skeleton, pose, pose).statesAt(0.0, states);
    if (!isTPose(arms, states, isZUp)) return static_cast<std::int64_t>(frame);
  }
  return static_cast<std::int64_t>(clip.frames.size());
}

}  // namespace foretouch::tools
