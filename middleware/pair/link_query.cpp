#include "middleware/pair/link_query.h"

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

std::array<double, 7> orderKey(const LinkContact& c) {
  return {c.separation - c.penetration,
          c.p_WScene.x(),
          c.p_WScene.y(),
          c.p_WScene.z(),
          c.nhat_SL_W.x(),
          c.nhat_SL_W.y(),
          c.nhat_SL_W.z()};
}

}  // namespace

Vector3d contactNormal(const Separation& axes) {
  if (axes.nhat.squaredNorm() > 0.5) return axes.nhat.normalized();
  if (axes.distance > 0.0) return axes.difference.stableNormalized();
  if (axes.featureNormal.stableNorm() > 0.0) return axes.featureNormal.stableNormalized();
  return Vector3d::Zero();
}

void beginAnswer(StepContacts& step) {
  step.links.clear();  // so that no old answer survives if there is no room for a new one
  step.perObject.clear();
  step.pairs.clear();
  step.arePairsAnswered = false;
  step.provenClearance = std::numeric_limits<double>::infinity();
  step.counters = {};
}

void leaveUnanswered(LinkId numLinks, std::vector<LinkContact>& links) {
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

int Pieces::amongSeveral(double t) const {
  int k = std::min(count - 1, static_cast<int>(t * count));
  // The product may have rounded across a boundary; the boundaries are what timeOf() says.
  while (k > 0 && t < timeOf(k)) --k;
  while (k + 1 < count && t >= timeOf(k + 1)) ++k;
  return k;
}

double nextPossible(const Pieces& pieces, const Candidate& candidate, double t) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (t >= pieces.end) return kNever;
  const std::uint32_t every = ~std::uint32_t{0} >> (kMaxPieces - pieces.count);
  if ((candidate.pieces & every) == every) return t;
  const int here = pieces.at(t);
  if ((candidate.pieces >> here & 1u) != 0) return t;
  for (int k = here + 1; k < pieces.count; ++k) {
    if ((candidate.pieces >> k & 1u) != 0) return pieces.timeOf(k);
  }
  return kNever;
}

MovingHull oneSideOf(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed) {
  MovingHull side = query.one.hullOf(candidate.lss, candidate.part, posed);
  side.radius *= candidate.radiusShare;
  return side;
}

MovingHull otherSideOf(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed) {
  if (query.other == nullptr) return MovingHull::still(query.scene->triangle(candidate.triangle));
  MovingHull side = query.other->hullAt(candidate.otherLss, candidate.otherPart, posed.other);
  side.radius *= candidate.radiusShare;
  return side;
}

TriangleId otherTriangle(const LinkQuery& query, const Candidate& candidate) {
  if (query.other == nullptr) return candidate.triangle;
  return candidate.otherPart.isTriangle() ? candidate.otherPart.index() : -1;
}

LinkQuery::Below LinkQuery::below(const Candidate& candidate) const {
  const auto radiusOf = [](const Side& side, std::int32_t lss, Part part) {
    return side.isSurface(lss, part) ? -1.0 : side.lssOf(lss, part).radius;
  };
  const bool isOther =
      other != nullptr && radiusOf(*other, candidate.otherLss, candidate.otherPart) >
                              radiusOf(one, candidate.lss, candidate.part);
  const std::array<Part, 2> children = isOther
                                           ? other->below(candidate.otherLss, candidate.otherPart)
                                           : one.below(candidate.lss, candidate.part);
  Below below{{candidate, candidate}, children[0] == children[1] ? std::size_t{1} : 2};
  for (std::size_t i = 0; i < 2; ++i) {
    Candidate& child = below.candidates[i];
    (isOther ? child.otherPart : child.part) = children[i];
  }
  return below;
}

double leastGap(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed) {
  const auto radiusOf = [](const Side& side, std::int32_t lss, Part part) {
    return part.isTriangle() ? 0.0 : side.lssOf(lss, part).radius;
  };
  const Side* const other = query.other;
  const Aabb box = query.one.boxOfPoints(candidate.lss, candidate.part, posed);
  double radii = radiusOf(query.one, candidate.lss, candidate.part);
  if (other != nullptr) radii += radiusOf(*other, candidate.otherLss, candidate.otherPart);
  const double gap =
      box.distance(other != nullptr
                       ? other->boxAt(candidate.otherLss, candidate.otherPart, posed.other)
                       : boxOf(query.scene->triangle(candidate.triangle))) -
      radii;
  return gap - kSlackOfRounding * (1.0 + std::abs(gap) + box.max.cwiseAbs().maxCoeff());
}

MovingPair pairOf(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed,
                  QueryCounters& counters) {
  ++counters.advancements;
  if (candidate.part.isTriangle()) ++counters.leafTests;
  if (query.isExact() && !candidate.part.isTriangle()) ++counters.hierarchyTests;
  return movingPair(oneSideOf(query, candidate, posed), otherSideOf(query, candidate, posed));
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

PairContact contactOf(const LinkQuery& query, const Candidate& candidate, const MovingPair& pair,
                      double t) {
  PairContact contact;
  contact.link = query.one.link;
  const bool areTriangles = pair.one.hull.count == 3 && pair.other.hull.count == 3;
  // At t = 0 no earlier proof keeps the pair apart: an LSS that we cannot prove apart counts as
  // touching; for triangles, the computed vertices give an exact answer.
  const bool starts =
      t == 0.0 && pair.gapLower() <= 0.0 &&
      (!areTriangles || trianglesMeet(pair.one.hull.triangle(), pair.other.hull.triangle()));
  contact.verdict = starts ? Verdict::StartsInContact : Verdict::Contact;
  contact.toi = contact.freeUntil = t;
  contact.separation = starts ? 0.0 : std::min(query.tolerance, std::max(0.0, pair.estimate()));
  contact.penetration = starts ? std::max(0.0, -pair.estimate()) : 0.0;
  contact.triangle = otherTriangle(query, candidate);
  contact.lss = candidate.lss;
  contact.nhat_SL_W = contactNormal(pair.axes);
  contact.p_WScene = pair.axes.onOther;
  contact.p_WLink = pair.axes.onOne - pair.one.radius * contact.nhat_SL_W;
  if (candidate.part.isTriangle()) {
    contact.linkTriangle = candidate.part.index();
    contact.linkFeature = featureAt(pair.one.hull.triangle(), pair.axes.onOne);
  }
  if (areTriangles) {
    contact.sceneFeature = featureAt(pair.other.hull.triangle(), pair.axes.onOther);
  }
  if (query.other != nullptr) {
    contact.p_WScene += pair.other.radius * contact.nhat_SL_W;
    contact.other = query.other->link;
    contact.otherLss = candidate.otherLss;
  }
  return contact;
}

bool comesFirst(const LinkContact& x, const LinkContact& y) {
  if (x.verdict != y.verdict) return x.verdict == Verdict::StartsInContact;
  const auto keyX = orderKey(x), keyY = orderKey(y);
  if (keyX != keyY) return keyX < keyY;
  return std::tie(x.triangle, x.lss, x.linkTriangle) < std::tie(y.triangle, y.lss, y.linkTriangle);
}

bool comesFirst(const PairContact& x, const PairContact& y) {
  const auto isFirst = [](const LinkContact& a, const LinkContact& b) { return comesFirst(a, b); };
  if (isFirst(x, y)) return true;
  return !isFirst(y, x) && x.otherLss < y.otherLss;
}

}  // namespace foretouch::internal
