#include "middleware/solid/own_features.h"

#include "lss/hull.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/solid/certifier.h"

namespace foretouch::internal {

bool findRow(const LssInWorld& one, const LssInWorld& other, double radii, double within,
             ContactRow& row) {
  // Balls around the axes first.
  const double apart = 0.5 * ((one.a + one.b) - (other.a + other.b)).norm();
  if (apart - 0.5 * ((one.a - one.b).norm() + (other.a - other.b).norm()) > within) return false;
  const Separation near = separation(Hull::segment(one.a, one.b), Hull::segment(other.a, other.b));
  if (near.distance > within || !(near.distance > 0.0)) return false;
  row.n = near.difference / near.distance;
  // Half of what pair radii take away belongs to either side.
  const double share = radii > 0.0 ? radii / (one.radius + other.radius) : 0.0;
  row.x = near.onOne - share * one.radius * row.n;
  row.y = near.onOther + share * other.radius * row.n;
  row.gap = near.lower() - radii;
  return true;
}

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
      const LssInWorld one{stateA.pointAt(lssA[i].a), stateA.pointAt(lssA[i].b), lssA[i].radius};
      for (std::size_t k = 0; k < lssB.size(); ++k) {
        const LssInWorld other{stateB.pointAt(lssB[k].a), stateB.pointAt(lssB[k].b),
                               lssB[k].radius};
        const double radii = ownRadii(plan, pair.a, static_cast<std::int32_t>(i), pair.b,
                                      static_cast<std::int32_t>(k));
        ContactRow row;
        if (!findRow(one, other, radii, radii + reachOfBoth, row)) continue;
        row.link = pair.a;
        row.lss = static_cast<std::int32_t>(i);
        row.other = pair.b;
        row.otherLss = static_cast<std::int32_t>(k);
        rows.push_back(row);
      }
    }
  }
}

}  // namespace foretouch::internal
