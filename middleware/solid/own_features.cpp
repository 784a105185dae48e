#include "middleware/solid/own_features.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/solid/certifier.h"

namespace foretouch::internal {
namespace {

/// Apart by balls around the axes, which is most pairs.
bool areFarApart(const LssInWorld& one, const LssInWorld& other, double within) {
  const double apart = 0.5 * ((one.a + one.b) - (other.a + other.b)).norm();
  return apart - 0.5 * ((one.a - one.b).norm() + (other.a - other.b).norm()) > within;
}

double gapBetween(const LssInWorld& one, const LssInWorld& other, double radii) {
  return separation(Hull::segment(one.a, one.b), Hull::segment(other.a, other.b)).distance - radii;
}

LssInWorld placed(const Lss& lss, const LinkState& state) {
  return {state.pointAt(lss.a), state.pointAt(lss.b), lss.radius};
}

}  // namespace

bool findRow(const LssInWorld& one, const LssInWorld& other, double radii, double within,
             ContactRow& row) {
  if (areFarApart(one, other, within)) return false;
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
  const Avatar& avatar = plan.avatar;
  std::optional<PairRules> rules = plan.options.self;
  if (!rules) {
    isSoft_ = true;
    auto derived = PairRules::derive(avatar);
    if (!derived.ok()) return;  // no two links that could be apart
    rules = std::move(derived).value();
  }
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    if (avatar.lss(a).empty()) continue;
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(b).empty()) continue;
      if (rules->reasonOf(a, b) == PairReason::Asked) pairs_.push_back({a, b});
    }
  }
}

void OwnFeatures::append(const QueryPlan& plan, const Places& places, double skin,
                         const std::vector<double>& reach, const std::vector<std::uint8_t>& isHot,
                         std::vector<ContactRow>& rows) const {
  for (const Asked& pair : pairs_) {
    if (isHot[slotOf(pair.a)] == 0 && isHot[slotOf(pair.b)] == 0) continue;
    const double reachOfBoth = reach[slotOf(pair.a)] + reach[slotOf(pair.b)];
    const auto& lssA = plan.avatar.lss(pair.a);
    const auto& lssB = plan.avatar.lss(pair.b);
    for (std::size_t i = 0; i < lssA.size(); ++i) {
      const LssInWorld one = placed(lssA[i], places.here[slotOf(pair.a)]);
      for (std::size_t k = 0; k < lssB.size(); ++k) {
        const LssInWorld other = placed(lssB[k], places.here[slotOf(pair.b)]);
        const double radii = isSoft_ ? one.radius + other.radius
                                     : ownRadii(plan, pair.a, static_cast<std::int32_t>(i), pair.b,
                                                static_cast<std::int32_t>(k));
        ContactRow row;
        if (!findRow(one, other, radii, radii + reachOfBoth, row)) continue;
        row.link = pair.a;
        row.lss = static_cast<std::int32_t>(i);
        row.other = pair.b;
        row.otherLss = static_cast<std::int32_t>(k);
        if (isSoft_) {
          const double wanted = gapBetween(placed(lssA[i], places.target[slotOf(pair.a)]),
                                           placed(lssB[k], places.target[slotOf(pair.b)]), radii);
          row.isSoft = true;
          row.slack = std::max(0.0, skin - wanted);
        }
        rows.push_back(row);
      }
    }
  }
}

OwnFeatures::Deeper OwnFeatures::findDeeper(const QueryPlan& plan,
                                            const std::vector<LinkState>& there,
                                            const Places& places, double by) const {
  if (!isSoft_) return {};
  for (const Asked& pair : pairs_) {
    for (const Lss& a : plan.avatar.lss(pair.a)) {
      const LssInWorld one = placed(a, there[slotOf(pair.a)]);
      for (const Lss& b : plan.avatar.lss(pair.b)) {
        const LssInWorld other = placed(b, there[slotOf(pair.b)]);
        const double radii = one.radius + other.radius;
        if (areFarApart(one, other, radii)) continue;
        const double gap = gapBetween(one, other, radii);
        if (!(gap < -by)) continue;
        const auto gapAt = [&](const std::vector<LinkState>& states) {
          return gapBetween(placed(a, states[slotOf(pair.a)]), placed(b, states[slotOf(pair.b)]),
                            radii);
        };
        if (gap < std::min({0.0, gapAt(places.target), gapAt(places.here)}) - by) {
          return {pair.a, pair.b};
        }
      }
    }
  }
  return {};
}

}  // namespace foretouch::internal
