#include "middleware/bracket/bracket_plan.h"

#include <algorithm>

#include "lss/rounding.h"

namespace foretouch::internal {

void BodyBrackets::begin(std::size_t numLinks) {
  growths.assign(numLinks, std::nullopt);
  most.assign(numLinks, 0.0);
  isOpen.assign(numLinks, 1);
  cuts = {};
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
