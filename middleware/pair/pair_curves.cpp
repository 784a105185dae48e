// What PairQuery proves along the curves of both sides' axes, before anything is looked at in lanes
// or in doubles.
#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/pair/pair_query.h"
#include "tessellation/axis_curve.h"

namespace foretouch::internal {
namespace {

/// Steps along curves before doubles look: two that slide along each other take many.
constexpr int kMostRounds = 200;

}  // namespace

/// Drops the candidates that never come near in the slab, and takes the others to where they do:
/// all but the last look is spared trigonometry.
void PairQuery::advanceAlongCurves(const LinkQuery& query, QueryCounters& counters) {
  one_.known.curves.clear();
  other_.known.curves.clear();
  StateCache states(query, counters);
  const auto isNever = [&](Candidate& candidate) {
    return !isNearAtStart(query, candidate, states, counters) &&
           !advance(query, candidate, counters);
  };
  std::vector<Candidate>& candidates = scratch_.candidates;
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), isNever), candidates.end());
}

/// For a mesh and an LSS. What is below the mesh's own decides, and no curve is needed before.
bool PairQuery::isNearAtStart(const LinkQuery& query, const Candidate& candidate,
                              StateCache& states, QueryCounters& counters) const {
  const bool mayStart = begin_ == 0.0 && (candidate.pieces & 1U) != 0 &&
                        query.isExact() != (query.other->surface != nullptr);
  return mayStart && !(pairOf(query, candidate, states.at(0.0), counters).gapLower() >
                       kHandOverShare * query.tolerance);
}

/// False: proven apart throughout the slab.
bool PairQuery::advance(const LinkQuery& query, Candidate& candidate, QueryCounters& counters) {
  const double floor = kFloorShare * query.tolerance, handOver = kHandOverShare * query.tolerance;
  double t = nextPossible(query.pieces, candidate, candidate.freeUntil);
  for (int round = 0; round < kMostRounds && t < end_; ++round) {
    candidate.freeUntil = t;
    ++counters.planeTests;
    const MovingPair pair = movingPair(
        alongCurve(one_, candidate.lss, query.one.frame, t, candidate.radiusShare, counters),
        alongCurve(other_, candidate.otherLss, query.one.frame, t, candidate.radiusShare,
                   counters));
    // Curves that are off by much of the tolerance cannot decide.
    if (!(pair.gapLower() > handOver)) return true;
    const double reached = timeAfter(t, pair.stepFrom(floor), end_);
    if (!(reached > t)) return true;
    t = nextPossible(query.pieces, candidate, reached);
  }
  return t < end_;
}

MovingHull PairQuery::alongCurve(const Moving& side, std::int32_t lss, LinkId frame, double t,
                                 double radiusShare, QueryCounters& counters) {
  const AxisCurve& curve = curveOf(side, lss, frame, counters);
  const AxisCurve::Ends ends = curve.endsAt(t);
  MovingHull hull;
  hull.hull = Hull::segment(ends.a, ends.b);
  hull.radius = side.plan.avatar.lss(side.link)[slotOf(lss)].radius * radiusShare;
  hull.moves = true;
  hull.velocity = {ends.velocityA, ends.velocityB, Eigen::Vector3d::Zero()};
  hull.acceleration = {curve.accelerationA, curve.accelerationB, 0.0};
  hull.positionRounding = {curve.error, curve.error, 0.0};
  hull.velocityRounding = {curve.velocityRounding, curve.velocityRounding, 0.0};
  return hull;
}

const AxisCurve& PairQuery::curveOf(const Moving& side, std::int32_t lss, LinkId frame,
                                    QueryCounters& counters) {
  const std::int32_t inTable = side.table().first(side.link) + lss;
  std::vector<KnownCurve>& curves = side.known.curves;
  for (const KnownCurve& known : curves) {
    if (known.lss == inTable) return known.curve;
  }
  evaluateNodes(counters);
  const ChainNodes& here = side.nodes();
  curves.push_back({inTable, axisCurve(side.table()[inTable], side.bounds, here,
                                       frame == kNoParent ? nullptr : &here.link(frame))});
  return curves.back().curve;
}

}  // namespace foretouch::internal
