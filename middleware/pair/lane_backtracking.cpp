#include "middleware/pair/lane_backtracking.h"

#include <algorithm>
#include <utility>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/pair/lane_sides.h"

namespace foretouch::internal {
namespace {

template <class Sides>
class LaneBacktracker {
 public:
  LaneBacktracker(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch,
                  QueryCounters& counters, LaneFrames* frames = nullptr)
      : query_(query),
        sides_(query, candidates, scratch),
        candidates_(candidates),
        scratch_(scratch),
        counters_(counters),
        frames_(frames),
        states_(query, counters),
        floor_(floatAbove(kFloorShare * query.tolerance)),
        handOver_(kHandOverShare * query.tolerance),
        end_(scratch.lanes.end()),
        standsStill_(Sides::kAnswersStarts &&
                     (query.one.surface == nullptr || query.other->surface == nullptr)) {}

  PairContact run() {
    start(0.0);
    if (!lookStill(0.0) || !lookAtAll()) return leftUndone();
    if (!best_) return PairContact{clearContact(query_.one.link)};
    // Pairs that moved on from the start are farther than what touches there.
    if (best_->verdict == Verdict::Contact && !lookAround() && isOpenAtStart()) return spent(0.0);
    return *best_;
  }

  PairContact runAround(const PairContact& contact) {
    take(contact);
    (void)lookAround();
    return *best_;
  }

 private:
  /// Looks until no pair is left that could change the answer; false if a spent budget ended it.
  [[nodiscard]] bool lookAtAll() {
    while (!scratch_.lss.isEmpty() || !scratch_.triangles.isEmpty()) {
      if (query_.meter.isPartSpent(counters_)) return false;
      // Triangles first: a contact makes all later pairs unnecessary.
      const bool areSurfaces =
          !scratch_.triangles.isEmpty() && !scratch_.lss.isBefore(scratch_.triangles);
      takeBatch(areSurfaces ? scratch_.triangles : scratch_.lss);
      if (count_ == 0) continue;
      if (frames_ != nullptr) std::exchange(frames_, nullptr)->make(scratch_.lanes, counters_);
      counters_.partSteps += count_;
      sides_.prove(areSurfaces, count_);
      for (std::size_t lane = 0; lane < count_; ++lane) settle(lane);
    }
    return true;
  }

  /// At one instant the parts of a mesh and an LSS stand still: no more than places counts. All
  /// that cut into each other at t = 0 touch at once, and the deepest is reported: of what is below
  /// a part the nearest comes first, down to the triangles. Their own bounds show that hardly any
  /// but the deepest can be reported; doubles decide between these. What is apart moves on from
  /// there. False if a spent budget ended it.
  [[nodiscard]] bool lookStill(double t) {
    if constexpr (Sides::kAnswersStarts) {
      std::vector<StillPair>& stack = scratch_.stillPairs;
      atMost_ = kInfinity;
      while (!stack.empty()) {
        if (query_.meter.isPartSpent(counters_)) return false;
        const StillPair pair = stack.back();
        stack.pop_back();
        lookDown(pair, t);
      }
      if (!lookAtSurfaces(t)) return false;
      if (horizon_ > t) {
        for (const StillPair& pair : scratch_.stillApart) push(sides_.movingFrom(t, pair));
      }
    }
    return true;
  }

  /// Looks from the pair down to triangles, by the nearest part of each.
  void lookDown(StillPair pair, double t) {
    while (!isTooFar(static_cast<double>(pair.nearest), t)) {
      if (pair.part.isTriangle()) return scratch_.stillSurfaces.push_back(pair);
      const WideNode& node = sides_.belowStill(pair);
      boundGaps(scratch_.stillAxes[slotOf(pair.candidate)], node.parts, scratch_.gaps);
      counters_.partSteps += slotOf(node.parts.count);
      const std::int32_t nearest = keepNear(node, pair.candidate, t);
      if (nearest < 0) return;
      pair.nearest = scratch_.gaps.lower[nearest];
      pair.part = node.below[slotOf(nearest)];
    }
  }

  /// Keeps all that may be near but the nearest that is not a triangle, whose lane it returns; -1:
  /// there is none.
  [[nodiscard]] std::int32_t keepNear(const WideNode& node, std::int32_t candidate, double t) {
    const PairFloats& gaps = scratch_.gaps.lower;
    std::int32_t nearest = -1;
    for (std::int32_t i = 0; i < node.parts.count; ++i) {
      const auto gap = static_cast<double>(gaps[i]);
      if (isTooFar(gap, t)) continue;
      const HierarchyChild part = node.below[slotOf(i)];
      if (gap > handOver_) {
        scratch_.stillApart.push_back({gaps[i], candidate, part});
      } else if (part.isTriangle()) {
        keepTouch(static_cast<double>(scratch_.gaps.upper[i]));
        scratch_.stillSurfaces.push_back({gaps[i], candidate, part});
      } else {
        const std::int32_t farther = nearest < 0 || gaps[i] < gaps[nearest] ? nearest : i;
        if (farther != i) nearest = i;
        if (farther < 0) continue;
        scratch_.stillPairs.push_back({gaps[farther], candidate, node.below[slotOf(farther)]});
      }
    }
    return nearest;
  }

  /// A pair that is no farther apart than this is well within the tolerance: doubles will say so.
  void keepTouch(double upper) {
    if (upper <= 0.5 * query_.tolerance) atMost_ = std::min(atMost_, upper);
  }

  /// False if a spent budget ended it.
  [[nodiscard]] bool lookAtSurfaces(double t) {
    std::vector<StillPair>& surfaces = scratch_.stillSurfaces;
    const auto isFar = [&](const StillPair& pair) {
      return isTooFar(static_cast<double>(pair.nearest), t);
    };
    surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isFar), surfaces.end());
    std::sort(surfaces.begin(), surfaces.end(),
              [](const StillPair& x, const StillPair& y) { return x.nearest > y.nearest; });
    while (!surfaces.empty()) {
      if (query_.meter.isPartSpent(counters_)) return false;
      const StillPair pair = surfaces.back();
      surfaces.pop_back();
      if (!isFar(pair)) look(sides_.movingFrom(t, pair));
    }
    return true;
  }

  /// Whether what is reported at `t`, or will be, is nearer.
  [[nodiscard]] bool isTooFar(double nearest, double t) const {
    return nearest > atMost_ || (horizon_ <= t && nearest > nearest_);
  }

  /// Pairs that moved on beyond the contact's instant, or were dropped, may be nearer at it: this
  /// tests all that lanes cannot prove farther. False if a spent budget ended it: the verdict
  /// stands, with the best contact seen.
  bool lookAround() {
    const double t = best_->toi, reach = reachOf(*best_);
    query_.neighbours.collect(t, states_.at(t), reach, candidates_, counters_);
    floor_ = floatAbove(reach);
    handOver_ = static_cast<double>(floor_);
    sides_.widen(reach);
    start(t);
    return lookStill(t) && lookAtAll();
  }

  /// Starts what may be near, from `t` on if not later.
  void start(double t) {
    scratch_.lss.reset(scratch_.lanes.begin(), end_);
    scratch_.triangles.reset(scratch_.lanes.begin(), end_);
    scratch_.stillPairs.clear();
    scratch_.stillSurfaces.clear();
    scratch_.stillApart.clear();
    scratch_.stillAxes.clear();
    sides_.readCandidates();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      PartPair pair;
      pair.freeUntil = nextPossible(query_.pieces, candidates_[i], candidates_[i].freeUntil);
      pair.candidate = static_cast<std::int32_t>(i);
      if (pair.freeUntil < end_) begin(pair, t);
    }
  }

  void begin(const PartPair& pair, double t) {
    if constexpr (Sides::kAnswersStarts) {
      const auto whole =
          standsStill_ && pair.freeUntil == t ? sides_.wholeStill(pair.candidate) : std::nullopt;
      if (whole) {
        if (scratch_.stillAxes.empty()) sides_.stopAt(states_.at(t));
        return scratch_.stillPairs.push_back(*whole);
      }
    }
    push(pair);
  }

  /// The remaining pairs bound how far the link is free; a contact that none of them can precede
  /// stands.
  [[nodiscard]] PairContact leftUndone() {
    const bool isStillOpen = !scratch_.stillPairs.empty() || !scratch_.stillSurfaces.empty();
    double freeUntil = isStillOpen ? 0.0 : horizon_;
    for (TimeBuckets* buckets : {&scratch_.lss, &scratch_.triangles}) {
      while (!buckets->isEmpty()) freeUntil = std::min(freeUntil, buckets->pop().freeUntil);
    }
    if (freeUntil == horizon_ && best_ && !isOpenAtStart()) return *best_;
    return spent(freeUntil);
  }

  /// A pair that was not looked at may be deeper, so whether the links start in contact is open.
  [[nodiscard]] bool isOpenAtStart() const {
    return Sides::kAnswersStarts && best_->toi == 0.0 && best_->verdict == Verdict::Contact;
  }
  [[nodiscard]] PairContact spent(double freeUntil) const {
    return PairContact{undecidedContact(query_.one.link, freeUntil, UndecidedReason::WorkBudget)};
  }

  void push(const PartPair& pair) {
    (Sides::isSurface(pair) ? scratch_.triangles : scratch_.lss).push(pair);
  }

  /// Fills the lanes with the earliest pairs.
  void takeBatch(TimeBuckets& buckets) {
    count_ = 0;
    const auto pushed = [this](const PartPair& pair) { push(pair); };
    while (count_ < kTrianglePairLanes && !buckets.isEmpty()) {
      const PartPair pair = buckets.pop();
      if (pair.freeUntil > horizon_ || sides_.enter(pair, pushed)) continue;
      if (sides_.isForDoubles(pair)) {
        look(pair);
        continue;
      }
      sides_.put(count_, pair, floor_);
      batch_[count_++] = pair;
    }
  }

  /// Advances a lane's pair as far as proven, or gives it up.
  void settle(std::size_t lane) {
    const PartPair& pair = batch_[lane];
    if (pair.freeUntil > horizon_) return;
    const double lower = scratch_.lanes.lower(lane);
    // Lanes begin at their own instants, of which 0 is one.
    if (horizon_ == 0.0 && lower > nearest_) return;
    if (lower > handOver_) {
      const double reached = scratch_.lanes.freeUntil(lane);
      if (reached > pair.freeUntil) return moveOn(pair, reached);
    }
    if (Sides::isSurface(pair)) return look(pair);
    sides_.descend(pair, [this](const PartPair& below) { push(below); });
  }

  void moveOn(PartPair pair, double reached) {
    // Against the scene there is one piece, and the candidate need not be read.
    pair.freeUntil = query_.pieces.count == 1
                         ? reached
                         : nextPossible(query_.pieces, sides_.candidateOf(pair), reached);
    if (pair.freeUntil >= end_ || pair.freeUntil > horizon_) return;
    push(pair);
  }

  /// Decides in doubles: contact, or advance.
  void look(const PartPair& pair) {
    const double t = pair.freeUntil;
    const Candidate candidate = sides_.inDoubles(pair);
    const MovingPair state = pairOf(query_, candidate, states_.at(t), counters_);
    if (state.gapUpper <= query_.tolerance) {
      const PairContact contact = contactOf(query_, candidate, state, t);
      if (t < horizon_ || best_->verdict == Verdict::Undecided || comesFirst(contact, *best_)) {
        take(contact);
      }
      return;
    }
    const double reached = provenFrom(query_, candidate, state, t, counters_);
    if (reached > t) return moveOn(pair, reached);
    giveUp(t);
  }

  /// What is farther apart at the same instant is not reported.
  void take(const PairContact& contact) {
    best_ = contact;
    horizon_ = contact.toi;
    nearest_ = reachOf(contact) - contact.penetration;
  }

  /// The numbers cannot resolve the pair; a contact at this instant stands.
  void giveUp(double t) {
    if (t == horizon_) return;
    nearest_ = kInfinity;
    best_ = PairContact{undecidedContact(query_.one.link, t, UndecidedReason::Resolution)};
    horizon_ = t;
  }

  const LinkQuery& query_;
  Sides sides_;
  std::vector<Candidate>& candidates_;
  PartScratch& scratch_;
  QueryCounters& counters_;
  LaneFrames* frames_;  // null once they are made
  StateCache states_;
  float floor_;
  double handOver_;
  double end_;
  bool standsStill_;  // at one instant: two links, one of which is made of LSS
  std::array<PartPair, kTrianglePairLanes> batch_;
  std::size_t count_ = 0;
  double horizon_ = kInfinity;       // nothing later than this can change the answer
  double atMost_ = kInfinity;        // something is as near as this, at the instant looked at
  double nearest_ = kInfinity;       // what is farther at the horizon comes after the contact there
  std::optional<PairContact> best_;  // nothing: horizon_ is infinite
};

}  // namespace

LinkContact nearestInLanes(const LinkQuery& query, const LinkContact& contact,
                           std::vector<Candidate>& candidates, PartScratch& scratch,
                           QueryCounters& counters) {
  FORETOUCH_ASSERT(query.isExact());
  return LaneBacktracker<MeshSides>(query, candidates, scratch, counters)
      .runAround(PairContact{contact});
}

PairContact backtrackInLanes(const LinkQuery& query, std::vector<Candidate>& candidates,
                             PartScratch& scratch, QueryCounters& counters, LaneFrames* frames) {
  FORETOUCH_ASSERT(!candidates.empty());
  if (query.other != nullptr) {
    return LaneBacktracker<OwnSides>(query, candidates, scratch, counters, frames).run();
  }
  if (query.one.skin != nullptr) {
    return LaneBacktracker<SkinSides>(query, candidates, scratch, counters).run();
  }
  return LaneBacktracker<MeshSides>(query, candidates, scratch, counters).run();
}

}  // namespace foretouch::internal
