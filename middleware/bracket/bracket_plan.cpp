#include "middleware/bracket/bracket_plan.h"

#include <algorithm>

#include "lss/rounding.h"

namespace foretouch::internal {

void BodyBrackets::begin(std::size_t numLinks) {
  growths.assign(numLinks, std::nullopt);
  most.assign(numLinks, 0.0);
  isOpen.assign(numLinks, 1);
  isMoved.assign(numLinks, 1);
  cuts = {};
}

void BodyBrackets::moveOpen(const Skeleton& skeleton) {
  isMoved = isOpen;
  for (JointId joint = skeleton.numJoints() - 1; joint >= 0; --joint) {
    const JointId parent = skeleton.parent(joint);
    if (isMoved[slotOf(joint)] != 0 && parent != kNoParent) isMoved[slotOf(parent)] = 1;
  }
}

BodyPlan BodyPlan::of(const Avatar& avatar, const std::optional<AvatarSurface>& surface) {
  BodyPlan body{avatar, surface, LssTable(avatar), {}};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    double rho = 0.0;
    for (const Lss& lss : avatar.lss(link)) {
      rho = std::max(rho, std::max(lss.a.norm(), lss.b.norm()) + (surface ? lss.radius : 0.0));
    }
    body.rho.push_back(rho * kInflation);
  }
  return body;
}

}  // namespace foretouch::internal
