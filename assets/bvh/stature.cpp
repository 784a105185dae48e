#include <vector>

#include "assets/bvh/bvh_reader.h"
#include "assets/bvh/bvh_roles.h"
#include "lss/index.h"

namespace foretouch {

std::optional<double> statureOf(const Skeleton& skeleton) {
  const std::vector<internal::BodyRole> roles = internal::bodyRoles(skeleton);
  std::vector<internal::RoleBone> bones;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    const JointId parent = skeleton.parent(joint);
    if (parent == kNoParent) continue;
    bones.push_back(
        {roles[slotOf(parent)], roles[slotOf(joint)], false, skeleton.restOffset(joint).norm()});
  }
  const internal::Legs legs = internal::legsOf(bones);
  // A skeleton has no End Sites: if a shin ends without a foot, its length is unknown.
  if (legs.knees == 0 || legs.ankles != legs.knees || !(legs.length > 0.0)) return std::nullopt;
  return legs.length / internal::kLegPerStature;
}

HeadAndFeet headAndFeetOf(const Skeleton& skeleton) {
  const std::vector<internal::BodyRole> roles = internal::bodyRoles(skeleton);
  HeadAndFeet found;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    const internal::BodyRole role = roles[slotOf(joint)];
    if (role == internal::BodyRole::Head && found.head == kNoParent) found.head = joint;
    if (role == internal::BodyRole::Foot) found.feet.push_back(joint);
  }
  return found;
}

}  // namespace foretouch
