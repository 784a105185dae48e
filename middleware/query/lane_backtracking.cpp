#include "middleware/query/lane_backtracking.h"

#include <algorithm>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class LaneBacktracker {
 public:
  LaneBacktracker(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch,
                  QueryCounters& counters)
      : query_(query),
        surface_(query.parts.surface),
        candidates_(candidates),
        scratch_(scratch),
        counters_(counters),
        states_(query, counters),
        floor_(floatAbove(kFloorShare * query.tolerance)),
        handOver_(kHandOverShare * query.tolerance),
        reach_(reachInLanes(query.tolerance)),
        end_(scratch.lanes.end()) {}

  LinkContact run() {
    prepare();
    start();
    if (!lookAtAll()) return leftUndone();
    if (best_ && best_->verdict == Verdict::Contact) lookAround();
    return best_ ? *best_ : clearContact(query_.parts.link);
  }

  LinkContact runAround(const LinkContact& contact) {
    prepare();
    best_ = contact;
    horizon_ = contact.toi;
    lookAround();
    return *best_;
  }

 private:
  void prepare() const {
    if (surface_ != nullptr) surface_->prepare();
  }

  /// Until no pair is left that could change the answer; false if a spent budget ended it.
  [[nodiscard]] bool lookAtAll() {
    while (!scratch_.lss.isEmpty() || !scratch_.triangles.isEmpty()) {
      if (query_.meter.isPartSpent(counters_)) return false;
      // Triangles first: a contact makes all later pairs unnecessary.
      const bool areTriangles =
          !scratch_.triangles.isEmpty() && !scratch_.lss.isBefore(scratch_.triangles);
      takeBatch(areTriangles ? scratch_.triangles : scratch_.lss);
      if (count_ == 0) continue;
      counters_.partSteps += count_;
      prove(areTriangles);
      for (std::size_t lane = 0; lane < count_; ++lane) settle(lane);
    }
    return true;
  }

  void prove(bool areTriangles) {
    PartLanes& lanes = scratch_.lanes;
    const BlendTriangle* const curves = scratch_.skin.curves();
    if (surface_ != nullptr) {
      areTriangles ? lanes.proveTriangles(count_) : lanes.proveLss(count_);
    } else {
      areTriangles ? lanes.proveBlendedTriangles(curves, count_)
                   : lanes.proveBlendedParts(curves, count_);
    }
  }

  /// Pairs that moved on beyond the contact's instant, or were dropped, may be nearer at it: this
  /// tests all that lanes cannot prove farther. A spent budget ends it: the verdict stands, with
  /// the best contact seen.
  void lookAround() {
    const double t = best_->toi, reach = reachOf(*best_);
    query_.neighbours.collect(t, states_.at(t), reach, candidates_, counters_);
    floor_ = floatAbove(reach);
    handOver_ = static_cast<double>(floor_);
    reach_ = std::max(reach_, reachInLanes(reach));
    start();
    (void)lookAtAll();
  }

  void start() {
    scratch_.lss.reset(scratch_.lanes.begin(), end_);
    scratch_.triangles.reset(scratch_.lanes.begin(), end_);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      PartPair pair;
      pair.freeUntil = candidates_[i].freeUntil;
      pair.candidate = static_cast<std::int32_t>(i);
      pair.isWhole = true;
      push(pair);
    }
  }

  /// The remaining pairs bound how far the link is free; a contact that none of them can precede
  /// stands.
  [[nodiscard]] LinkContact leftUndone() {
    double freeUntil = horizon_;
    for (TimeBuckets* buckets : {&scratch_.lss, &scratch_.triangles}) {
      while (!buckets->isEmpty()) freeUntil = std::min(freeUntil, buckets->pop().freeUntil);
    }
    if (freeUntil == horizon_ && best_) return *best_;
    return undecidedContact(query_.parts.link, freeUntil, UndecidedReason::WorkBudget);
  }

  void push(const PartPair& pair) {
    (!pair.isWhole && pair.part.isTriangle() ? scratch_.triangles : scratch_.lss).push(pair);
  }

  [[nodiscard]] const Candidate& candidateOf(const PartPair& pair) const {
    return candidates_[slotOf(pair.candidate)];
  }
  /// The LSS contains no triangle: it is the surface, and its pairs go to doubles.
  [[nodiscard]] bool isBare(const PartPair& pair) const {
    return surface_ != nullptr && !surface_->hasTriangles(candidateOf(pair).lss);
  }
  /// Fills the lanes with the earliest pairs.
  void takeBatch(TimeBuckets& buckets) {
    count_ = 0;
    while (count_ < kTrianglePairLanes && !buckets.isEmpty()) {
      const PartPair pair = buckets.pop();
      if (pair.freeUntil > horizon_) continue;
      if (pair.isWhole && !isBare(pair)) {
        enter(pair);
        continue;
      }
      if (pair.isWhole || (pair.part.isTriangle() && query_.leafProver != nullptr)) {
        look(pair);
        continue;
      }
      put(pair);
    }
  }

  void put(const PartPair& pair) {
    const Candidate& candidate = candidateOf(pair);
    const float u = scratch_.lanes.laneTime(pair.freeUntil);
    if (surface_ != nullptr) {
      scratch_.lanes.put(count_, candidate.laneTriangle,
                         surface_->lanePart(candidate.lss, pair.part), u, floor_);
    } else {
      const std::int32_t curve = scratch_.skin.curve(pair.part);
      scratch_.lanes.putBlend(count_, candidate.laneTriangle, curve, scratch_.skin.hull(curve), u,
                              floor_);
    }
    batch_[count_++] = pair;
  }

  /// Advances a lane's pair as far as proven, or gives it up.
  void settle(std::size_t lane) {
    const PartPair& pair = batch_[lane];
    if (pair.freeUntil > horizon_) return;
    if (scratch_.lanes.lower(lane) > handOver_) {
      const double reached = scratch_.lanes.freeUntil(lane);
      if (reached > pair.freeUntil) return moveOn(pair, reached);
    }
    if (pair.part.isTriangle()) return look(pair);
    descend(pair);
  }

  void moveOn(PartPair pair, double reached) {
    if (reached >= end_ || reached > horizon_) return;
    pair.freeUntil = reached;
    push(pair);
  }

  /// Descends from an LSS, which lanes gave up as a whole, into its hierarchy.
  void enter(PartPair pair) {
    Candidate& candidate = candidates_[slotOf(pair.candidate)];
    if (candidate.laneTriangle < 0) {
      candidate.laneTriangle = scratch_.lanes.add(query_.scene.triangle(candidate.triangle));
    }
    pair.isWhole = false;
    if (surface_ == nullptr) return enterCluster(pair, candidate.lss);
    pair.part = surface_->root(candidate.lss);
    if (pair.part.isTriangle()) {
      push(pair);
    } else {
      descend(pair);
    }
  }

  void enterCluster(PartPair pair, std::int32_t lss) {
    const PartRange parts = scratch_.skin.partsOf(lss);
    for (std::int32_t part = parts.first; part < parts.last; ++part) {
      pushIfNear(pair, HierarchyChild::node(part));
    }
  }

  void descend(PartPair pair) {
    if (surface_ == nullptr) return descendSkin(pair);
    for (const HierarchyChild part : surface_->below(candidateOf(pair).lss, pair.part)) {
      pair.part = part;
      push(pair);
    }
  }

  void descendSkin(PartPair pair) {
    const PartRange triangles = scratch_.skin.trianglesOf(pair.part);
    for (std::int32_t i = triangles.first; i < triangles.last; ++i) {
      pushIfNear(pair, scratch_.skin.triangle(i));
    }
  }

  /// Unless the boxes over the whole span are farther apart than any contact.
  void pushIfNear(PartPair pair, HierarchyChild part) {
    const CurveBox& scene = scratch_.lanes.box(candidateOf(pair).laneTriangle);
    const std::int32_t curve = scratch_.skin.curve(part);
    if (!scratch_.skin.hull(curve).swept.isNear(scene, reach_)) return;
    pair.part = part;
    push(pair);
  }

  /// Decides in doubles: contact, or advance.
  void look(const PartPair& pair) {
    const double t = pair.freeUntil;
    Candidate candidate = candidateOf(pair);
    if (!pair.isWhole) candidate.part = Part::of(pair.part);
    if (surface_ == nullptr) candidate.lss = 0;  // a cluster's number means nothing outside
    const MovingPair state = pairOf(query_, candidate, states_.at(t), counters_);
    if (state.gapUpper <= query_.tolerance) {
      const LinkContact contact = contactOf(query_, candidate, state, t);
      if (t < horizon_ || best_->verdict == Verdict::Undecided || comesFirst(contact, *best_)) {
        best_ = contact;
      }
      horizon_ = t;
      return;
    }
    const double reached = provenFrom(query_, candidate, state, t, counters_);
    if (reached > t) return moveOn(pair, reached);
    giveUp(t);
  }

  /// The numbers cannot resolve the pair; a contact at this instant stands.
  void giveUp(double t) {
    if (t == horizon_) return;
    best_ = undecidedContact(query_.parts.link, t, UndecidedReason::Resolution);
    horizon_ = t;
  }

  const LinkQuery& query_;
  const LinkSurface* surface_;  // null: the triangles are those of a skin
  std::vector<Candidate>& candidates_;
  PartScratch& scratch_;
  QueryCounters& counters_;
  StateCache states_;
  float floor_;
  double handOver_;
  float reach_;
  double end_;
  std::array<PartPair, kTrianglePairLanes> batch_;
  std::size_t count_ = 0;
  double horizon_ = kInfinity;       // nothing later than this can change the answer
  std::optional<LinkContact> best_;  // nothing: horizon_ is infinite
};

}  // namespace

void TimeBuckets::reset(double begin, double end) {
  FORETOUCH_ASSERT(begin < end);
  begin_ = begin;
  bucketsPerTime_ = kBuckets / (end - begin);
  occupied_ = 0;
  free_ = kNone;
  entries_.clear();
}

LinkContact nearestInLanes(const LinkQuery& query, const LinkContact& contact,
                           std::vector<Candidate>& candidates, PartScratch& scratch,
                           QueryCounters& counters) {
  FORETOUCH_ASSERT(query.isExact());
  return LaneBacktracker(query, candidates, scratch, counters).runAround(contact);
}

LinkContact backtrackInLanes(const LinkQuery& query, std::vector<Candidate>& candidates,
                             PartScratch& scratch, QueryCounters& counters) {
  FORETOUCH_ASSERT((query.isExact() || query.parts.skin != nullptr) && !candidates.empty());
  return LaneBacktracker(query, candidates, scratch, counters).run();
}

}  // namespace foretouch::internal
