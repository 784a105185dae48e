#include "tests/reference/limbs.h"

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/pair/pairs_asked.h"

namespace foretouch::internal {
namespace {

void addPoints(const Avatar& avatar, LinkId link, std::vector<AxisPoint>& points) {
  for (const Lss& lss : avatar.lss(link)) {
    for (const Eigen::Vector3d& end : {lss.a, lss.b}) {
      points.push_back({link, {end.x(), end.y(), end.z()}, end.norm() * kInflation, lss.radius});
    }
  }
}

}  // namespace

Limbs::Limbs(const Avatar& avatar) {
  const std::vector<int> children = childrenThatCount(avatar);
  std::vector<std::int32_t> limbOf(children.size(), -1);
  isCarrier_.assign(children.size(), 0);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const auto i = slotOf(link);
    const JointId parent = avatar.skeleton().parent(link);
    if (parent == kNoParent) isCarrier_[i] = 1;
    if (avatar.lss(link).empty() && children[i] == 0) continue;
    const bool begins = parent == kNoParent || children[slotOf(parent)] > 1;
    if (parent == kNoParent) trees_.push_back({link, {}, {}});
    if (begins) {
      isCarrier_[i] = 1;
      limbOf[i] = static_cast<std::int32_t>(limbs_.size());
      limbs_.emplace_back();
      limbs_.back().carrier = link;
      limbs_.back().tree = parent == kNoParent ? static_cast<std::int32_t>(trees_.size()) - 1
                                               : limbs_[slotOf(limbOf[slotOf(parent)])].tree;
    } else {
      limbOf[i] = limbOf[slotOf(parent)];
    }
    if (avatar.lss(link).empty()) continue;
    Limb& limb = limbs_[slotOf(limbOf[i])];
    limb.links.push_back(link);
    addPoints(avatar, link, limb.points);
    trees_[slotOf(limb.tree)].links.push_back(link);
  }
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    if (limbs_[i].links.empty()) continue;  // bare links between two branchings
    trees_[slotOf(limbs_[i].tree)].limbs.push_back(static_cast<std::int32_t>(i));
  }
}

}  // namespace foretouch::internal
