#include "middleware/query/link_query.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/exact/feature.h"
#include "middleware/exact/triangles_meet.h"
#include "middleware/scene/culler.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Thousands of roundings of what doubles compute.
constexpr double kSlackOfRounding = 1e-12;

/// Scene to link. If part and triangle meet, their difference has no direction: then the normal of
/// the features, then any unit vector.
Vector3d contactNormal(const Separation& axes) {
  if (axes.nhat.squaredNorm() > 0.5) return axes.nhat.normalized();
  if (axes.distance > 0.0) return axes.difference.stableNormalized();
  if (axes.featureNormal.stableNorm() > 0.0) return axes.featureNormal.stableNormalized();
  return Vector3d::UnitY();
}

}  // namespace

void leaveUnanswered(LinkId numLinks, std::vector<LinkContact>& links) {
  links.clear();  // so that no old answer survives if there is no room for a new one
  links.assign(countOf(numLinks), LinkContact());  // copies one; resize() is four times as slow
  for (LinkId link = 0; link < numLinks; ++link) {
    links[slotOf(link)].link = link;
  }
}

LinkContact clearContact(LinkId link) {
  LinkContact contact;
  contact.link = link;
  answerClear(contact);
  return contact;
}

int Pieces::at(double t) const {
  int k = std::min(count - 1, static_cast<int>(t * count));
  // The product may have rounded across a boundary; the boundaries are what timeOf() says.
  while (k > 0 && t < timeOf(k)) --k;
  while (k + 1 < count && t >= timeOf(k + 1)) ++k;
  return k;
}

std::array<Part, 2> LinkQuery::below(std::int32_t lss, Part part) const {
  const LssHierarchy& hierarchy = parts.surface->hierarchy(lss);
  HierarchyChild child = hierarchy.root();
  if (part.isWhole() && child.isTriangle()) return {Part::of(child), Part::of(child)};
  if (!part.isWhole()) child = HierarchyChild::node(part.index());
  const auto& children = hierarchy.node(child.index()).children;
  return {Part::of(children[0]), Part::of(children[1])};
}

double leastGap(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed) {
  const Aabb box = query.parts.boxOfPoints(candidate.lss, candidate.part, posed);
  const double radius =
      candidate.part.isTriangle() ? 0.0 : query.parts.lssOf(candidate.lss, candidate.part).radius;
  const double gap = box.distance(boxOf(query.scene.triangle(candidate.triangle))) - radius;
  return gap - kSlackOfRounding * (1.0 + std::abs(gap) + box.max.cwiseAbs().maxCoeff());
}

MovingPair pairOf(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed,
                  QueryCounters& counters) {
  ++counters.advancements;
  if (candidate.part.isTriangle()) ++counters.leafTests;
  if (query.isExact() && !candidate.part.isTriangle()) ++counters.hierarchyTests;
  return movingPair(query.parts.hullOf(candidate.lss, candidate.part, posed),
                    MovingHull::still(query.scene.triangle(candidate.triangle)));
}

double provenFrom(const LinkQuery& query, const Candidate& candidate, const MovingPair& pair,
                  double t, QueryCounters& counters) {
  if (query.leafProver != nullptr && query.isExact() && candidate.part.isTriangle()) {
    const double reached = query.leafProver->freeUntil(query, candidate, pair, t, counters);
    if (reached > t) return reached;
  }
  return timeAfter(t, pair.stepFrom(kFloorShare * query.tolerance), 1.0);
}

double reachOf(const LinkContact& contact) {
  const double coordinates = contact.p_WScene.cwiseAbs().maxCoeff();
  return contact.separation + kSlackOfRounding * (1.0 + contact.separation + coordinates);
}

LinkContact contactOf(const LinkQuery& query, const Candidate& candidate, const MovingPair& pair,
                      double t) {
  LinkContact contact;
  contact.link = query.parts.link;
  // At t = 0 no earlier proof keeps the pair apart: an LSS that we cannot prove apart counts as
  // touching; for triangles, the computed vertices give an exact answer.
  const bool starts = t == 0.0 && pair.gapLower() <= 0.0 &&
                      (!candidate.part.isTriangle() ||
                       trianglesMeet(pair.one.hull.triangle(), pair.other.hull.triangle()));
  contact.verdict = starts ? Verdict::StartsInContact : Verdict::Contact;
  contact.toi = contact.freeUntil = t;
  contact.separation = starts ? 0.0 : std::min(query.tolerance, std::max(0.0, pair.estimate()));
  contact.penetration = starts ? std::max(0.0, -pair.estimate()) : 0.0;
  contact.triangle = candidate.triangle;
  contact.lss = candidate.lss;
  contact.nhat_SL_W = contactNormal(pair.axes);
  contact.p_WScene = pair.axes.onOther;
  contact.p_WLink = pair.axes.onOne - pair.one.radius * contact.nhat_SL_W;
  if (candidate.part.isTriangle()) {
    contact.linkTriangle = candidate.part.index();
    contact.linkFeature = featureAt(pair.one.hull.triangle(), pair.axes.onOne);
    contact.sceneFeature = featureAt(pair.other.hull.triangle(), pair.axes.onOther);
  }
  return contact;
}

bool comesFirst(const LinkContact& x, const LinkContact& y) {
  if (x.verdict != y.verdict) return x.verdict == Verdict::StartsInContact;
  const auto key = [](const LinkContact& c) {
    return std::array<double, 7>{c.separation - c.penetration,
                                 c.p_WScene.x(),
                                 c.p_WScene.y(),
                                 c.p_WScene.z(),
                                 c.nhat_SL_W.x(),
                                 c.nhat_SL_W.y(),
                                 c.nhat_SL_W.z()};
  };
  const auto keyX = key(x), keyY = key(y);
  if (keyX != keyY) return keyX < keyY;
  return std::tie(x.triangle, x.lss, x.linkTriangle) < std::tie(y.triangle, y.lss, y.linkTriangle);
}

}  // namespace foretouch::internal
