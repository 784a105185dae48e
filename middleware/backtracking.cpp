#include "middleware/backtracking.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "lss/separation.h"
#include "middleware/culler.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A step never goes below this share of the tolerance, so that contact is found from outside.
constexpr double kFloorShare = 0.25;
/// Rounds steps down past the rounding of their formula (some ten roundings of positive terms).
constexpr double kStepShrink = 1.0 - 1e-12;

/// Later first, so that the standard heap's top is the earliest; the triangle makes the order
/// total.
struct Later {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.freeUntil != y.freeUntil) return x.freeUntil > y.freeUntil;
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    return x.lss > y.lss;
  }
};

/// Farther first, so that the heap's top is the nearest; total likewise.
struct Farther {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.nearest != y.nearest) return x.nearest > y.nearest;
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    return x.lss > y.lss;
  }
};

/// One LSS and one triangle at one instant, with everything rounding may have done on the safe
/// side.
struct PairState {
  Separation axis;    // of the axis and the triangle
  double gapA, gapB;  // proven: the plane's clearance of each end, less radius
  double gapUpper;    // proven: the separation of LSS surface and triangle is at most this
  double radius;
  Vector3d velocityA, velocityB;

  [[nodiscard]] double gapLower() const { return std::min(gapA, gapB); }
  [[nodiscard]] double estimate() const { return axis.closest.distance - radius; }
};

class Backtracker {
 public:
  Backtracker(const LinkQuery& query, std::vector<Candidate>& heap, QueryCounters& counters)
      : query_(query), heap_(heap), counters_(counters) {}

  LinkContact run() {
    best_.link = query_.link;
    startCandidates();
    while (!heap_.empty() && !hasContact() && heap_.front().freeUntil <= horizon_) {
      if (spent_ >= query_.maxAdvancements) {
        giveUp(heap_.front().freeUntil, UndecidedReason::WorkBudget);
        break;
      }
      std::pop_heap(heap_.begin(), heap_.end(), Later{});
      advance(heap_.back());
    }
    if (hasContact()) settleTies();
    return best_;
  }

  LinkContact runAtStart() {
    best_.link = query_.link;
    lookNearestFirst(0.0);
    return best_;
  }

 private:
  void startCandidates() {
    for (Candidate& candidate : heap_) {
      FORETOUCH_ASSERT(candidate.pieces != 0);
      candidate.freeUntil = nextPossible(candidate, 0.0);
    }
    std::make_heap(heap_.begin(), heap_.end(), Later{});
  }

  /// The earliest instant from `t` on at which the pair's boxes meet; infinity if none before 1.
  [[nodiscard]] double nextPossible(const Candidate& candidate, double t) const {
    if (t >= 1.0) return kInfinity;
    const int here = query_.pieces.at(t);
    if ((candidate.pieces >> here & 1u) != 0) return t;
    for (int k = here + 1; k < query_.pieces.count; ++k) {
      if ((candidate.pieces >> k & 1u) != 0) return query_.pieces.timeOf(k);
    }
    return kInfinity;
  }

  /// Looks at the candidate (the heap's last, just popped) at its instant and moves it on, ends it,
  /// or takes it as the link's contact.
  void advance(Candidate& candidate) {
    const double t = candidate.freeUntil;
    const PairState pair = pairAt(candidate, t);
    if (pair.gapUpper <= query_.tolerance) {
      best_ = contactOf(candidate, pair, t);
      heap_.pop_back();
      return;
    }
    const double next = t + stepFrom(candidate, pair);
    // Rounding the sum may have moved it up by half a unit in the last place.
    const double reached = next >= 1.0 ? 1.0 : std::nextafter(next, 0.0);
    if (!(reached > t)) {
      giveUp(t, UndecidedReason::Resolution);
      heap_.pop_back();
      return;
    }
    candidate.freeUntil = nextPossible(candidate, reached);
    if (candidate.freeUntil <= horizon_ && candidate.freeUntil < 1.0) {
      std::push_heap(heap_.begin(), heap_.end(), Later{});
    } else {
      heap_.pop_back();
    }
  }

  [[nodiscard]] double stepFrom(const Candidate& candidate, const PairState& pair) const {
    const double floor = kFloorShare * query_.tolerance;
    if (!(pair.gapLower() > floor)) return 0.0;
    const AxisBounds& bounds = query_.axisBounds[static_cast<std::size_t>(candidate.lss)];
    const double speedA = pair.axis.nhat.dot(pair.velocityA) - bounds.velocityRoundingA;
    const double speedB = pair.axis.nhat.dot(pair.velocityB) - bounds.velocityRoundingB;
    return std::min(safeStep(pair.gapA - floor, speedA, bounds.accelerationA),
                    safeStep(pair.gapB - floor, speedB, bounds.accelerationB));
  }

  [[nodiscard]] const LinkState& stateAt(double t) {
    if (t != stateTime_) {
      state_ = query_.motion.stateAt(query_.link, t);
      stateTime_ = t;
      ++counters_.states;
    }
    return state_;
  }

  [[nodiscard]] PairState pairAt(const Candidate& candidate, double t) {
    ++counters_.advancements;
    ++spent_;
    const auto index = static_cast<std::size_t>(candidate.lss);
    const Lss& lss = query_.lss[index];
    const AxisBounds& bounds = query_.axisBounds[index];
    const LinkState& state = stateAt(t);
    const AxisEnds ends = axisEnds(lss, state);
    PairState pair;
    pair.axis = separation(ends.a, ends.b, query_.scene.triangle(candidate.triangle));
    pair.radius = lss.radius;
    // The differences below round once each, by at most kUnitRoundoff of what is subtracted.
    const double radiusSlack = 4.0 * kUnitRoundoff * (lss.radius + std::abs(pair.axis.upper));
    pair.gapA = pair.axis.clearanceA - bounds.positionRoundingA - lss.radius - radiusSlack;
    pair.gapB = pair.axis.clearanceB - bounds.positionRoundingB - lss.radius - radiusSlack;
    pair.gapUpper = pair.axis.upper + std::max(bounds.positionRoundingA, bounds.positionRoundingB) -
                    lss.radius + radiusSlack;
    pair.velocityA = state.velocityAt(lss.a);
    pair.velocityB = state.velocityAt(lss.b);
    return pair;
  }

  [[nodiscard]] bool hasContact() const {
    return best_.verdict == Verdict::Contact || best_.verdict == Verdict::StartsInContact;
  }

  /// Of the contacts at the very instant of the first one found, finds the one that is reported.
  /// What is left in the heap is not earlier, and what is later does not matter.
  void settleTies() {
    const double t = best_.toi;
    const auto tiesEnd = std::partition(heap_.begin(), heap_.end(),
                                        [t](const Candidate& c) { return c.freeUntil == t; });
    heap_.erase(tiesEnd, heap_.end());
    lookNearestFirst(t);
  }

  /// Finds the contact at `t` that is reported, if there is one. A limb deep in furniture touches
  /// thousands of triangles at once and the smallest separation wins, so the nearest boxes are
  /// looked at first, until the boxes alone tell that no better one is left. Once there is a
  /// contact the budget has no say: the verdict stands, and which contact is reported must not
  /// depend on it.
  void lookNearestFirst(double t) {
    for (Candidate& candidate : heap_) candidate.nearest = leastGap(candidate, t);
    std::make_heap(heap_.begin(), heap_.end(), Farther{});
    while (!heap_.empty() && heap_.front().nearest <= reach()) {
      if (!hasContact() && spent_ >= query_.maxAdvancements) return;
      std::pop_heap(heap_.begin(), heap_.end(), Farther{});
      const PairState pair = pairAt(heap_.back(), t);
      if (pair.gapUpper <= query_.tolerance) {
        const LinkContact contact = contactOf(heap_.back(), pair, t);
        if (!hasContact() || comesFirst(contact, best_)) best_ = contact;
      }
      heap_.pop_back();
    }
  }

  /// What is farther than this is no contact, or none that could be reported.
  [[nodiscard]] double reach() const {
    return hasContact() ? best_.separation - best_.penetration : query_.tolerance;
  }

  /// A lower bound on the gap that contactOf() would find, by the boxes of axis and triangle. The
  /// slack, thousands of roundings of the coordinates, keeps it below whatever either side rounds
  /// to.
  [[nodiscard]] double leastGap(const Candidate& candidate, double t) {
    const Lss& lss = query_.lss[static_cast<std::size_t>(candidate.lss)];
    const AxisEnds ends = axisEnds(lss, stateAt(t));
    Aabb axis;
    axis.add(ends.a);
    axis.add(ends.b);
    const double gap = axis.distance(boxOf(query_.scene.triangle(candidate.triangle))) - lss.radius;
    return gap - 1e-12 * (1.0 + std::abs(gap) + axis.max.cwiseAbs().maxCoeff());
  }

  void giveUp(double t, UndecidedReason reason) {
    if (best_.verdict != Verdict::Clear) return;  // a contact at this very instant stands
    best_.verdict = Verdict::Undecided;
    best_.reason = reason;
    best_.freeUntil = best_.toi = horizon_ = t;
  }

  [[nodiscard]] LinkContact contactOf(const Candidate& candidate, const PairState& pair,
                                      double t) const {
    LinkContact contact;
    contact.link = query_.link;
    // At t = 0 nothing before it proves the pair apart: what cannot be proven apart counts as
    // touching.
    const bool starts = t == 0.0 && pair.gapLower() <= 0.0;
    contact.verdict = starts ? Verdict::StartsInContact : Verdict::Contact;
    contact.toi = contact.freeUntil = t;
    contact.separation = starts ? 0.0 : std::min(query_.tolerance, std::max(0.0, pair.estimate()));
    contact.penetration = starts ? std::max(0.0, -pair.estimate()) : 0.0;
    contact.triangle = candidate.triangle;
    contact.lss = candidate.lss;
    contact.nhat_SL_W = contactNormal(pair);
    contact.p_WScene = pair.axis.closest.onTriangle;
    contact.p_WLink = pair.axis.closest.onSegment - pair.radius * contact.nhat_SL_W;
    return contact;
  }

  /// Scene to link. Where axis and triangle meet, their difference has no direction: then the
  /// normal of the features, then any unit vector.
  [[nodiscard]] static Vector3d contactNormal(const PairState& pair) {
    if (pair.axis.nhat.squaredNorm() > 0.5) return pair.axis.nhat.normalized();
    if (pair.axis.closest.distance > 0.0) return pair.axis.closest.difference.stableNormalized();
    if (pair.axis.closest.featureNormal.stableNorm() > 0.0) {
      return pair.axis.closest.featureNormal.stableNormalized();
    }
    return Vector3d::UnitY();
  }

  /// The order of contacts with equal toi, as query.h states it.
  [[nodiscard]] static bool comesFirst(const LinkContact& x, const LinkContact& y) {
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
    return x.triangle != y.triangle ? x.triangle < y.triangle : x.lss < y.lss;
  }

  const LinkQuery& query_;
  std::vector<Candidate>& heap_;
  QueryCounters& counters_;
  LinkContact best_;
  double horizon_ = kInfinity;  // nothing later than this can change the answer
  std::uint64_t spent_ = 0;
  LinkState state_;
  double stateTime_ = -1.0;
};

}  // namespace

int Pieces::at(double t) const {
  int k = std::min(count - 1, static_cast<int>(t * count));
  // The product may have rounded across a boundary; the boundaries are what timeOf() says.
  while (k > 0 && t < timeOf(k)) --k;
  while (k + 1 < count && t >= timeOf(k + 1)) ++k;
  return k;
}

double safeStep(double clearance, double speed, double acceleration) {
  FORETOUCH_ASSERT(clearance > 0.0 && acceleration >= 0.0);
  const double root = std::sqrt(speed * speed + 2.0 * acceleration * clearance);
  // Two forms of the positive root, each a sum of terms of one sign.
  if (speed <= 0.0) {
    const double closing = root - speed;
    return closing > 0.0 ? kStepShrink * (2.0 * clearance / closing) : kInfinity;
  }
  return acceleration > 0.0 ? kStepShrink * ((speed + root) / acceleration) : kInfinity;
}

LinkContact contactAtStart(const LinkQuery& query, std::vector<Candidate>& candidates,
                           QueryCounters& counters) {
  return Backtracker(query, candidates, counters).runAtStart();
}

LinkContact backtrack(const LinkQuery& query, std::vector<Candidate>& candidates,
                      QueryCounters& counters) {
  return Backtracker(query, candidates, counters).run();
}

}  // namespace foretouch::internal
