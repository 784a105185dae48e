#include "assets/bvh/body_parts.h"

#include <algorithm>

#include "assets/bvh/bvh_roles.h"

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

std::vector<LinkId> namedTrunkOf(const Skeleton& skeleton) {
  return linksWith(internal::bodyRoles(skeleton),
                   {BodyRole::Pelvis, BodyRole::Torso, BodyRole::Neck, BodyRole::Head});
}

std::vector<LinkId> trunkOf(const Skeleton& skeleton) {
  std::vector<LinkId> trunk = namedTrunkOf(skeleton);
  if (trunk.empty()) {
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) trunk.push_back(link);
  }
  return trunk;
}

std::vector<LinkId> feetOf(const Skeleton& skeleton) {
  return linksWith(internal::bodyRoles(skeleton), {BodyRole::Foot, BodyRole::Toe});
}

}  // namespace foretouch
