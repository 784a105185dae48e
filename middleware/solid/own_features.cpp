#include "middleware/solid/own_features.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "lss/closest_features.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/solid/certifier.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

/// For two LSS that overlap at rest: how much of their radii, and a cosine between an axis and the
/// way from one to the other.
constexpr double kMostOverlap = 0.75, kEndOn = 0.7;
/// A cosine: normals of two rows of one pair that lies along each other; and where two are one (m).
constexpr double kAlong = 0.9, kSameEnd = 5e-3;

/// Whether balls around the axes prove them apart, as they do for most pairs.
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

Eigen::Vector3d closestOn(const LssInWorld& lss, const Eigen::Vector3d& p) {
  const Edge axis(lss.a, lss.b - lss.a);
  return axis.at(axis.project(p));
}

/// For a pair that lies along each other: the closest points alone would let it turn about them, to
/// and fro. Copies `row` for each end of an axis that is as near to the other axis.
void appendEnds(const LssInWorld& one, const LssInWorld& other, double radii, double within,
                const ContactRow& row, std::vector<ContactRow>& rows) {
  const double share = radii / (one.radius + other.radius);
  const auto append = [&](std::int32_t number, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const double apart = (p - q).norm();
    if (!(apart > 0.0) || apart > within) return;
    ContactRow end = row;
    end.end = number;
    end.n = (p - q) / apart;
    end.x = p - share * one.radius * end.n;
    end.y = q + share * other.radius * end.n;
    end.gap = apart - radii;
    const bool isThere = (end.x - row.x).norm() < kSameEnd;
    if (!isThere && end.n.dot(row.n) > kAlong) rows.push_back(end);
  };
  append(0, one.a, closestOn(other, one.a));
  append(1, one.b, closestOn(other, one.b));
  append(2, closestOn(one, other.a), other.a);
  append(3, closestOn(one, other.b), other.b);
}

/// Two that overlap at rest can be kept no deeper than they are tracked if they lie side by side
/// there. Those whose axes all but meet, as at a common joint, have no side to be on; and no
/// joint between them can part those that lie end to end, as along a spine.
bool lieSideBySide(const LssInWorld& one, const LssInWorld& other) {
  const Separation apart = separation(Hull::segment(one.a, one.b), Hull::segment(other.a, other.b));
  if (apart.distance < (1.0 - kMostOverlap) * (one.radius + other.radius)) return false;
  const auto isEndOn = [&](const LssInWorld& lss) {
    const Eigen::Vector3d axis = lss.b - lss.a;
    return std::abs(axis.dot(apart.difference)) > kEndOn * axis.norm() * apart.distance;
  };
  return !isEndOn(one) && !isEndOn(other);
}

bool lieSideBySide(const Avatar& avatar, const std::vector<LinkState>& rest, LinkId a, LinkId b) {
  for (const Lss& one : avatar.lss(a)) {
    for (const Lss& other : avatar.lss(b)) {
      const LssInWorld atA = placed(one, rest[slotOf(a)]), atB = placed(other, rest[slotOf(b)]);
      if (gapBetween(atA, atB, one.radius + other.radius) < 0.0 && !lieSideBySide(atA, atB)) {
        return false;
      }
    }
  }
  return true;
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

double gapOf(const QueryPlan& plan, const ContactRow& row, const std::vector<LinkState>& states) {
  const LinkId other = row.other == kNoParent ? row.link : row.other;
  const LinkState &atLink = states[slotOf(row.link)], &atOther = states[slotOf(other)];
  if (row.end < 0) {
    return gapOf(plan, {row.link, row.lss, row.triangle, row.other, row.otherLss}, atLink, atOther);
  }
  const LssInWorld one = placed(plan.avatar.lss(row.link)[slotOf(row.lss)], atLink);
  const LssInWorld two = placed(plan.avatar.lss(row.other)[slotOf(row.otherLss)], atOther);
  const Eigen::Vector3d p = row.end == 0   ? one.a
                            : row.end == 1 ? one.b
                            : row.end == 2 ? two.a
                                           : two.b;
  const double apart = (p - closestOn(row.end < 2 ? two : one, p)).norm();
  return apart - ownRadii(plan, row.link, row.lss, row.other, row.otherLss);
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
  std::vector<LinkState> rest;
  placeLinks(avatar.skeleton(), restPose(avatar.skeleton()), rest);
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    if (avatar.lss(a).empty()) continue;
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(b).empty()) continue;
      const PairReason reason = rules->reasonOf(a, b);
      const bool isWish =
          isSoft_ && reason == PairReason::RestOverlap && lieSideBySide(avatar, rest, a, b);
      if (reason == PairReason::Asked || isWish) pairs_.push_back({a, b});
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
        if (radii > 0.0) appendEnds(one, other, radii, radii + reachOfBoth, row, rows);
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
