#include "middleware/backtracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "middleware/culler.h"
#include "middleware/exact/chain_piece.h"
#include "middleware/exact/feature.h"
#include "middleware/exact/linear_query.h"
#include "middleware/exact/start.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Later first, so that the standard heap's top is the earliest; the triangle makes the order
/// total.
struct Later {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.freeUntil != y.freeUntil) return x.freeUntil > y.freeUntil;
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    if (x.lss != y.lss) return x.lss > y.lss;
    return y.part < x.part;
  }
};

/// Farther first, so that the heap's top is the nearest; total likewise.
struct Farther {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.nearest != y.nearest) return x.nearest > y.nearest;
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    if (x.lss != y.lss) return x.lss > y.lss;
    return y.part < x.part;
  }
};

/// t + step, rounded down, and at most 1: the sum may have been moved up by half a unit in the last
/// place.
double after(double t, double step) {
  const double next = t + step;
  return next >= 1.0 ? 1.0 : std::nextafter(next, 0.0);
}

class Backtracker {
 public:
  Backtracker(const LinkQuery& query, std::vector<Candidate>& heap, QueryCounters& counters)
      : query_(query), heap_(heap), counters_(counters), states_(query, counters) {}

  LinkContact run() {
    best_.link = query_.parts.link;
    startCandidates();
    while (!heap_.empty() && !hasContact() && heap_.front().freeUntil <= horizon_) {
      if (query_.meter.isPartSpent(counters_)) {
        giveUp(heap_.front().freeUntil, UndecidedReason::WorkBudget);
        break;
      }
      std::pop_heap(heap_.begin(), heap_.end(), Later{});
      advance();
    }
    if (hasContact()) settleTies();
    return best_;
  }

  LinkContact runAtStart() {
    best_.link = query_.parts.link;
    lookNearestFirst(0.0);
    return best_;
  }

 private:
  void startCandidates() {
    for (Candidate& candidate : heap_) {
      FORETOUCH_ASSERT(candidate.pieces != 0);
      candidate.freeUntil = nextPossible(candidate, candidate.freeUntil);
    }
    std::make_heap(heap_.begin(), heap_.end(), Later{});
  }

  /// The earliest instant from `t` on at which the pair's boxes meet; infinity if none before 1.
  [[nodiscard]] double nextPossible(const Candidate& candidate, double t) const {
    if (t >= candidate.end) return kInfinity;
    const int here = query_.pieces.at(t);
    if ((candidate.pieces >> here & 1u) != 0) return t;
    for (int k = here + 1; k < query_.pieces.count; ++k) {
      if ((candidate.pieces >> k & 1u) != 0) return query_.pieces.timeOf(k);
    }
    return kInfinity;
  }

  /// Looks at the candidate (the heap's last, just popped) at its instant and moves it on, ends it,
  /// puts the parts below in its place, or takes it as the link's contact.
  void advance() {
    Candidate& candidate = heap_.back();
    const double t = candidate.freeUntil;
    const PairState pair = pairAt(candidate, t);
    const bool isSurface = query_.isSurface(candidate.lss, candidate.part);
    if (pair.gapUpper <= query_.tolerance) {
      if (!isSurface) return descendFrom(pair, t);
      best_ = contactOf(query_, candidate, pair, t);
      heap_.pop_back();
      return;
    }
    const double reached = provenFrom(query_, candidate, pair, t, counters_);
    if (!(reached > t)) {
      if (!isSurface) return descendFrom(pair, t);
      giveUp(t, UndecidedReason::Resolution);
      heap_.pop_back();
      return;
    }
    candidate.freeUntil = nextPossible(candidate, reached);
    candidate.nearest = -kInfinity;
    if (candidate.freeUntil <= horizon_ && candidate.freeUntil < 1.0) {
      std::push_heap(heap_.begin(), heap_.end(), Later{});
    } else {
      heap_.pop_back();
    }
  }

  /// From an instant on, the two parts below take the place of the heap's last candidate; the plane
  /// that was found for it moves them on where it can.
  void descendFrom(const PairState& pair, double t) {
    descend(Later{}, [&](Candidate& part) {
      ++counters_.planeTests;
      const double step = query_.parts.stepByPlane(part.lss, part.part, states_.at(t).state,
                                                   query_.scene.triangle(part.triangle), pair.nhat,
                                                   query_.tolerance);
      if (step > 0.0) part.freeUntil = nextPossible(part, after(t, step));
    });
  }

  /// Puts the two parts below in the place of the heap's last candidate. `prepare` makes each ready
  /// for the order that the heap is in.
  template <typename Order, typename Prepare>
  void descend(const Order& order, const Prepare& prepare) {
    const Candidate parent = heap_.back();
    heap_.pop_back();
    const std::array<Part, 2> parts = query_.below(parent.lss, parent.part);
    for (std::size_t i = 0; i < 2; ++i) {
      if (i == 1 && parts[1] == parts[0]) break;
      Candidate child = parent;
      child.part = parts[i];
      prepare(child);
      if (!(child.freeUntil < 1.0) || child.freeUntil > horizon_) continue;
      heap_.push_back(child);
      std::push_heap(heap_.begin(), heap_.end(), order);
    }
  }

  [[nodiscard]] PairState pairAt(const Candidate& candidate, double t) {
    return pairOf(query_, candidate, states_.at(t), counters_);
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
  /// looked at first, until the boxes alone tell that no better one is left. A spent budget ends
  /// it: the verdict stands, and of its contacts the best one that was seen.
  void lookNearestFirst(double t) {
    for (Candidate& candidate : heap_) {
      candidate.nearest = std::max(candidate.nearest, leastGap(query_, candidate, states_.at(t)));
    }
    std::make_heap(heap_.begin(), heap_.end(), Farther{});
    while (!heap_.empty() && heap_.front().nearest <= reach()) {
      if (query_.meter.isPartSpent(counters_)) return settleUnseen(t);
      std::pop_heap(heap_.begin(), heap_.end(), Farther{});
      const PairState pair = pairAt(heap_.back(), t);
      if (pair.gapUpper <= query_.tolerance &&
          !query_.isSurface(heap_.back().lss, heap_.back().part)) {
        descend(Farther{}, [&](Candidate& part) {
          part.nearest = std::max(part.nearest, leastGap(query_, part, states_.at(t)));
        });
        continue;
      }
      if (pair.gapUpper <= query_.tolerance) {
        const LinkContact contact = contactOf(query_, heap_.back(), pair, t);
        if (!hasContact() || comesFirst(contact, best_)) best_ = contact;
      }
      heap_.pop_back();
    }
  }

  /// At t = 0 what was not looked at may go deeper than the contact that was found: whether the
  /// link starts in contact is then open. Later, being free before it, nothing can.
  void settleUnseen(double t) {
    if (t > 0.0 || best_.verdict != Verdict::Contact) return;
    best_ = undecidedContact(query_.parts.link, 0.0, UndecidedReason::WorkBudget);
  }

  /// What is farther than this is no contact, or none that could be reported.
  [[nodiscard]] double reach() const {
    return hasContact() ? best_.separation - best_.penetration : query_.tolerance;
  }

  void giveUp(double t, UndecidedReason reason) {
    if (best_.verdict != Verdict::Clear) return;  // a contact at this very instant stands
    best_ = undecidedContact(query_.parts.link, t, reason);
    horizon_ = t;
  }

  const LinkQuery& query_;
  std::vector<Candidate>& heap_;
  QueryCounters& counters_;
  LinkContact best_;
  double horizon_ = kInfinity;  // nothing later than this can change the answer
  StateCache states_;
};

/// Scene to link. Where part and triangle meet, their difference has no direction: then the
/// normal of the features, then any unit vector.
Vector3d contactNormal(const PairState& pair) {
  if (pair.nhat.squaredNorm() > 0.5) return pair.nhat.normalized();
  if (pair.distance > 0.0) return pair.difference.stableNormalized();
  if (pair.featureNormal.stableNorm() > 0.0) return pair.featureNormal.stableNormalized();
  return Vector3d::UnitY();
}

}  // namespace

LinkContact undecidedContact(LinkId link, double freeUntil, UndecidedReason reason) {
  LinkContact contact;
  contact.link = link;
  contact.verdict = Verdict::Undecided;
  contact.reason = reason;
  contact.freeUntil = contact.toi = freeUntil;
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
  return gap - 1e-12 * (1.0 + std::abs(gap) + box.max.cwiseAbs().maxCoeff());
}

PairState pairOf(const LinkQuery& query, const Candidate& candidate, const PosedLink& posed,
                 QueryCounters& counters) {
  ++counters.advancements;
  if (candidate.part.isTriangle()) ++counters.leafTests;
  if (query.isExact() && !candidate.part.isTriangle()) ++counters.hierarchyTests;
  return query.parts.pair(candidate.lss, candidate.part, posed,
                          query.scene.triangle(candidate.triangle));
}

double provenFrom(const LinkQuery& query, const Candidate& candidate, const PairState& pair,
                  double t, QueryCounters& counters) {
  const double floor = kFloorShare * query.tolerance;
  if (query.leafMethod == LeafMethod::Cubics && query.isExact() && candidate.part.isTriangle()) {
    ++counters.cubicTests;
    const double reached = freeUntilByCubics(query.evaluator, query.parts.link, t, 1.0,
                                             query.parts.surface->triangle(candidate.part.index()),
                                             query.scene.triangle(candidate.triangle), floor,
                                             kFloorShare * query.tolerance, pair.nhat);
    if (reached > t) return reached;
  }
  return after(t, stepFrom(pair, floor));
}

LinkContact contactOf(const LinkQuery& query, const Candidate& candidate, const PairState& pair,
                      double t) {
  LinkContact contact;
  contact.link = query.parts.link;
  // At t = 0 nothing before it proves the pair apart: of an LSS what cannot be proven apart counts
  // as touching; triangles, where the computed vertices are, have an exact answer.
  const bool starts = t == 0.0 && pair.gapLower() <= 0.0 &&
                      (!candidate.part.isTriangle() ||
                       trianglesMeet(pair.hull, query.scene.triangle(candidate.triangle)));
  contact.verdict = starts ? Verdict::StartsInContact : Verdict::Contact;
  contact.toi = contact.freeUntil = t;
  contact.separation = starts ? 0.0 : std::min(query.tolerance, std::max(0.0, pair.estimate()));
  contact.penetration = starts ? std::max(0.0, -pair.estimate()) : 0.0;
  contact.triangle = candidate.triangle;
  contact.lss = candidate.lss;
  contact.nhat_SL_W = contactNormal(pair);
  contact.p_WScene = pair.onScene;
  contact.p_WLink = pair.onHull - pair.radius * contact.nhat_SL_W;
  if (candidate.part.isTriangle()) {
    contact.linkTriangle = candidate.part.index();
    contact.linkFeature = featureAt(pair.hull, pair.onHull);
    contact.sceneFeature = featureAt(query.scene.triangle(candidate.triangle), pair.onScene);
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

LinkContact contactAtStart(const LinkQuery& query, std::vector<Candidate>& candidates,
                           QueryCounters& counters) {
  if (query.isExact()) return meshContactAtStart(query, candidates, nullptr, counters);
  return Backtracker(query, candidates, counters).runAtStart();
}

LinkContact backtrack(const LinkQuery& query, std::vector<Candidate>& candidates,
                      QueryCounters& counters) {
  return Backtracker(query, candidates, counters).run();
}

}  // namespace foretouch::internal
