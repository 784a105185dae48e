#include "assets/bvh/body_parts.h"

#include <algorithm>

#include "articulated/motion.h"
#include "assets/bvh/bvh_roles.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using internal::BodyRole;

std::vector<LinkId> linksWith(const std::vector<BodyRole>& roles,
                              std::initializer_list<BodyRole> wanted) {
  std::vector<LinkId> links;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (std::find(wanted.begin(), wanted.end(), roles[i]) != wanted.end()) {
      links.push_back(static_cast<LinkId>(i));
    }
  }
  return links;
}

}  // namespace

std::optional<Eigen::Vector3d> footToHead(const Skeleton& skeleton, const Pose& pose) {
  const std::vector<BodyRole> roles = internal::bodyRoles(skeleton);
  const std::vector<LinkId> ankles = linksWith(roles, {BodyRole::Foot});
  std::vector<LinkId> top;
  for (const BodyRole role : {BodyRole::Head, BodyRole::Neck, BodyRole::Torso}) {
    if (top.empty()) top = linksWith(roles, {role});
  }
  if (ankles.empty() || top.empty()) return std::nullopt;
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  Eigen::Vector3d feet = Eigen::Vector3d::Zero();
  for (const LinkId ankle : ankles) feet += states[slotOf(ankle)].p_WL;
  return states[slotOf(top.back())].p_WL - feet / static_cast<double>(ankles.size());
}

std::vector<LinkId> trunkOf(const Skeleton& skeleton) {
  std::vector<LinkId> trunk =
      linksWith(internal::bodyRoles(skeleton),
                {BodyRole::Pelvis, BodyRole::Torso, BodyRole::Neck, BodyRole::Head});
  if (trunk.empty()) {
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) trunk.push_back(link);
  }
  return trunk;
}

std::vector<LinkId> feetOf(const Skeleton& skeleton) {
  return linksWith(internal::bodyRoles(skeleton), {BodyRole::Foot, BodyRole::Toe});
}

}  // namespace foretouch
