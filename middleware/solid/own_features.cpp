#include "middleware/solid/own_features.h"

#include "lss/hull.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/solid/certifier.h"

namespace foretouch::internal {

OwnFeatures::OwnFeatures(const QueryPlan& plan) {
  if (!plan.options.self) return;
  for (LinkId a = 0; a < plan.avatar.numLinks(); ++a) {
    if (plan.avatar.lss(a).empty()) continue;
    for (LinkId b = a + 1; b < plan.avatar.numLinks(); ++b) {
      if (plan.avatar.lss(b).empty()) continue;
      if (plan.options.self->reasonOf(a, b) == PairReason::Asked) pairs_.push_back({a, b});
    }
  }
}

void OwnFeatures::append(const QueryPlan& plan, const std::vector<LinkState>& states,
                         const std::vector<double>& reach, const std::vector<std::uint8_t>& isHot,
                         std::vector<ContactRow>& rows) const {
  for (const Asked& pair : pairs_) {
    if (isHot[slotOf(pair.a)] == 0 && isHot[slotOf(pair.b)] == 0) continue;
    const double reachOfBoth = reach[slotOf(pair.a)] + reach[slotOf(pair.b)];
    const auto& lssA = plan.avatar.lss(pair.a);
    const auto& lssB = plan.avatar.lss(pair.b);
    const LinkState &stateA = states[slotOf(pair.a)], &stateB = states[slotOf(pair.b)];
    for (std::size_t i = 0; i < lssA.size(); ++i) {
      const Eigen::Vector3d a = stateA.pointAt(lssA[i].a), b = stateA.pointAt(lssA[i].b);
      for (std::size_t k = 0; k < lssB.size(); ++k) {
        const Eigen::Vector3d c = stateB.pointAt(lssB[k].a), d = stateB.pointAt(lssB[k].b);
        const double radii = ownRadii(plan, pair.a, static_cast<std::int32_t>(i), pair.b,
                                      static_cast<std::int32_t>(k));
        const double within = radii + reachOfBoth;
        // Balls around the axes first.
        const double apart = 0.5 * ((a + b) - (c + d)).norm();
        if (apart - 0.5 * ((a - b).norm() + (c - d).norm()) > within) continue;
        const Separation near = separation(Hull::segment(a, b), Hull::segment(c, d));
        if (near.distance > within || !(near.distance > 0.0)) continue;
        ContactRow row;
        row.link = pair.a;
        row.lss = static_cast<std::int32_t>(i);
        row.other = pair.b;
        row.otherLss = static_cast<std::int32_t>(k);
        row.n = near.difference / near.distance;
        // Half of what pair radii take away belongs to either side.
        const double share = radii / (lssA[i].radius + lssB[k].radius);
        row.x = near.onOne - share * lssA[i].radius * row.n;
        row.y = near.onOther + share * lssB[k].radius * row.n;
        row.gap = near.lower() - radii;
        rows.push_back(row);
      }
    }
  }
}

}  // namespace foretouch::internal
