#include "middleware/query/skin_start.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foretouch::internal {
namespace {

/// Thousands of roundings of what doubles compute.
constexpr double kStartRounding = 1e-12;

double leastX(const Triangle& triangle) {
  const auto& v = triangle.vertices;
  return std::min({v[0].x(), v[1].x(), v[2].x()});
}

/// Pairs at t = 0 of a cluster's parts, or of a part's triangles, that lanes do not refute.
class StartSearch {
 public:
  StartSearch(const LinkQuery& query, PartScratch& scratch, QueryCounters& counters)
      : query_(query),
        scratch_(scratch),
        counters_(counters),
        reach_(reachInLanes(query.tolerance)) {}

  /// From clusters to their parts; false if the work was spent.
  [[nodiscard]] bool keepParts(const std::vector<Candidate>& clusters) {
    scratch_.partPairs.clear();
    for (const Candidate& cluster : clusters) {
      if (query_.meter.isPartSpent(counters_)) return false;
      Candidate pair = cluster;
      pair.laneTriangle = scratch_.lanes.add(query_.scene.triangle(cluster.triangle));
      pair.lss = 0;  // a cluster's number means nothing outside
      const PartRange parts = scratch_.skin.partsOf(cluster.lss);
      for (std::int32_t part = parts.first; part < parts.last; ++part) {
        put(pair, HierarchyChild::node(part));
        if (count_ == kTrianglePairLanes) settleParts();
      }
    }
    settleParts();
    return true;
  }

  /// From the parts to their triangles; false if the work was spent.
  [[nodiscard]] bool keepTriangles() {
    scratch_.startPairs.clear();
    for (const Candidate& pair : scratch_.partPairs) {
      if (query_.meter.isPartSpent(counters_)) return false;
      const PartRange triangles =
          scratch_.skin.trianglesOf(HierarchyChild::node(pair.part.index()));
      for (std::int32_t i = triangles.first; i < triangles.last; ++i) {
        put(pair, scratch_.skin.triangle(i));
        if (count_ == kTrianglePairLanes) settleTriangles();
      }
    }
    settleTriangles();
    return true;
  }

 private:
  /// Unless the boxes at the start are farther apart than any contact.
  void put(const Candidate& pair, HierarchyChild part) {
    const std::int32_t curve = scratch_.skin.curve(part);
    const CurveBox& scene = scratch_.lanes.box(pair.laneTriangle);
    if (!scratch_.skin.hull(curve).start.isNear(scene, reach_)) return;
    scratch_.lanes.putBlend(count_, pair.laneTriangle, curve, scratch_.skin.hull(curve),
                            scratch_.lanes.laneTime(0.0), 0.0F);
    batch_[count_] = pair;
    batch_[count_++].part = Part::of(part);
  }

  void settleParts() {
    scratch_.lanes.proveBlendedParts(scratch_.skin.curves(), count_);
    settle([&](const Candidate& pair, std::size_t) { scratch_.partPairs.push_back(pair); });
  }

  void settleTriangles() {
    scratch_.lanes.proveBlendedTriangles(scratch_.skin.curves(), count_);
    settle([&](const Candidate& pair, std::size_t lane) {
      const double least =
          std::max(scratch_.lanes.leastX(lane), leastX(query_.scene.triangle(pair.triangle)));
      scratch_.startPairs.push_back({pair, least - kStartRounding * (1.0 + std::abs(least))});
    });
  }

  template <typename Keep>
  void settle(const Keep& keep) {
    counters_.partSteps += count_;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      // What doubles find is farther from the truth by rounding.
      const double lower = scratch_.lanes.lower(lane);
      batch_[lane].nearest = lower - kStartRounding * (1.0 + std::abs(lower));
      if (batch_[lane].nearest <= query_.tolerance) keep(batch_[lane], lane);
    }
    count_ = 0;
  }

  const LinkQuery& query_;
  PartScratch& scratch_;
  QueryCounters& counters_;
  float reach_;
  std::array<Candidate, kTrianglePairLanes> batch_;
  std::size_t count_ = 0;
};

/// Decides in doubles which pair comes first (comesFirst()). Among those that touch it is the one
/// with the least x, so these are looked at by theirs until no better one can be left.
class StartLook {
 public:
  StartLook(const LinkQuery& query, std::vector<StartPair>& pairs, QueryCounters& counters)
      : query_(query), pairs_(pairs), counters_(counters), states_(query, counters) {}

  std::optional<LinkContact> run() {
    const auto apart = std::partition(pairs_.begin(), pairs_.end(),
                                      [](const StartPair& p) { return p.pair.nearest <= 0.0; });
    std::sort(pairs_.begin(), apart, isBefore<&StartLook::leastX>);
    for (auto pair = pairs_.begin(); pair != apart; ++pair) {
      if (touches() && pair->leastX > best_->p_WScene.x()) return best_;
      if (!look(pair->pair)) return unseen();
    }
    if (touches()) return best_;
    std::sort(apart, pairs_.end(), isBefore<&StartLook::nearest>);
    for (auto pair = apart; pair != pairs_.end() && pair->pair.nearest <= reach(); ++pair) {
      if (!look(pair->pair)) return unseen();
    }
    return best_;
  }

 private:
  static double leastX(const StartPair& pair) { return pair.leastX; }
  static double nearest(const StartPair& pair) { return pair.pair.nearest; }
  /// A total order, so that the work does not depend on that of the pairs.
  template <double (*kKey)(const StartPair&)>
  static bool isBefore(const StartPair& x, const StartPair& y) {
    if (kKey(x) != kKey(y)) return kKey(x) < kKey(y);
    if (x.pair.triangle != y.pair.triangle) return x.pair.triangle < y.pair.triangle;
    return x.pair.part < y.pair.part;
  }

  [[nodiscard]] bool touches() const { return best_ && best_->verdict == Verdict::StartsInContact; }
  [[nodiscard]] double reach() const { return best_ ? best_->separation : query_.tolerance; }

  /// False if the work was spent.
  [[nodiscard]] bool look(const Candidate& candidate) {
    if (query_.meter.isPartSpent(counters_)) return false;
    const MovingPair pair = pairOf(query_, candidate, states_.at(0.0), counters_);
    if (pair.gapUpper > query_.tolerance) return true;
    const LinkContact contact = contactOf(query_, candidate, pair, 0.0);
    if (!best_ || comesFirst(contact, *best_)) best_ = contact;
    return true;
  }

  /// A touch stands; whether there is another than a Contact is open.
  [[nodiscard]] LinkContact unseen() const {
    if (touches()) return *best_;
    return undecidedContact(query_.parts.link, 0.0, UndecidedReason::WorkBudget);
  }

  const LinkQuery& query_;
  std::vector<StartPair>& pairs_;
  QueryCounters& counters_;
  StateCache states_;
  std::optional<LinkContact> best_;
};

}  // namespace

std::optional<LinkContact> skinContactAtStart(const LinkQuery& query,
                                              const std::vector<Candidate>& clusters,
                                              PartScratch& scratch, QueryCounters& counters) {
  StartSearch search(query, scratch, counters);
  if (!search.keepParts(clusters) || !search.keepTriangles()) {
    return undecidedContact(query.parts.link, 0.0, UndecidedReason::WorkBudget);
  }
  return StartLook(query, scratch.startPairs, counters).run();
}

}  // namespace foretouch::internal
