#include "middleware/pair/skin_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace foretouch::internal {
namespace {

/// Thousands of roundings of what doubles compute.
constexpr double kSkinStartRounding = 1e-12;

/// Clusters' pairs that go to lanes together. What they find saves later ones.
constexpr std::size_t kPairsAtOnce = 32;

/// The least x of a point that both sides share, as doubles compute it.
double leastX(const Triangle& triangle) {
  const auto& v = triangle.vertices;
  const double least = std::min({v[0].x(), v[1].x(), v[2].x()});
  return least - kSkinStartRounding * (1.0 + std::abs(least));
}

bool isBefore(const StartPair& x, const StartPair& y) {
  if (x.leastX != y.leastX) return x.leastX < y.leastX;
  if (x.pair.triangle != y.pair.triangle) return x.pair.triangle < y.pair.triangle;
  if (x.pair.lss != y.pair.lss) return x.pair.lss < y.pair.lss;
  return x.pair.part < y.pair.part;
}

/// The pairs at t = 0 of clusters' triangles that lanes do not refute.
class SkinStartSearch {
 public:
  SkinStartSearch(const LinkQuery& query, PartScratch& scratch, QueryCounters& counters)
      : query_(query),
        scratch_(scratch),
        counters_(counters),
        reach_(reachInLanes(query.tolerance)) {}

  /// From now on leaves out what can share no point with x up to this.
  void keepUpTo(double x) {
    mostX_ = scratch_.lanes.laneX(x + 2.0 * kSkinStartRounding * (1.0 + std::abs(x)));
  }

  /// Replaces startPairs and adds to nearPairs.
  void expand(const StartPair* first, const StartPair* last) {
    scratch_.partPairs.clear();
    scratch_.startPairs.clear();
    for (; first != last; ++first) expandCluster(first->pair);
    settleParts();
    for (const Candidate& pair : scratch_.partPairs) expandPart(pair);
    settleTriangles();
  }

 private:
  void expandCluster(const Candidate& cluster) {
    Candidate pair = cluster;
    pair.laneTriangle = scratch_.lanes.add(query_.scene->triangle(cluster.triangle));
    pair.lss = 0;  // a cluster's number means nothing outside
    const PartRange parts = scratch_.skin.partsOf(cluster.lss);
    for (std::int32_t part = parts.first; part < parts.last; ++part) {
      put(pair, HierarchyChild::node(part));
      if (count_ == kTrianglePairLanes) settleParts();
    }
  }

  void expandPart(const Candidate& pair) {
    const PartRange triangles = scratch_.skin.trianglesOf(HierarchyChild::node(pair.part.index()));
    for (std::int32_t i = triangles.first; i < triangles.last; ++i) {
      put(pair, scratch_.skin.triangle(i));
      if (count_ == kTrianglePairLanes) settleTriangles();
    }
  }

  /// Puts it unless the boxes at the start are farther apart than any contact.
  void put(const Candidate& pair, HierarchyChild part) {
    const std::int32_t curve = scratch_.skin.curve(part);
    const CurveBox& scene = scratch_.lanes.box(pair.laneTriangle);
    const CurveBox& own = scratch_.skin.hull(curve).start;
    if (std::max(own.lower[0], scene.lower[0]) > mostX_ || !own.isNear(scene, reach_)) return;
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
      if (pair.nearest > 0.0) return scratch_.nearPairs.push_back(pair);
      const double least = scratch_.lanes.leastX(lane);
      scratch_.startPairs.push_back(
          {pair, std::max(least - kSkinStartRounding * (1.0 + std::abs(least)),
                          leastX(query_.scene->triangle(pair.triangle)))});
    });
  }

  template <typename Keep>
  void settle(const Keep& keep) {
    counters_.partSteps += count_;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      // What doubles find is farther from the truth by rounding.
      const double lower = scratch_.lanes.lower(lane);
      batch_[lane].nearest = lower - kSkinStartRounding * (1.0 + std::abs(lower));
      if (batch_[lane].nearest <= query_.tolerance) keep(batch_[lane], lane);
    }
    count_ = 0;
  }

  const LinkQuery& query_;
  PartScratch& scratch_;
  QueryCounters& counters_;
  float reach_;
  float mostX_ = std::numeric_limits<float>::infinity();
  std::array<Candidate, kTrianglePairLanes> batch_;
  std::size_t count_ = 0;
};

/// Decides in doubles which pair comes first (comesFirst()). Among those that touch it is the one
/// with the least x, so these are looked at by theirs until no better one can be left.
class StartLook {
 public:
  StartLook(const LinkQuery& query, QueryCounters& counters)
      : query_(query), counters_(counters), states_(query, counters) {}

  [[nodiscard]] bool touches() const { return best_ && best_->verdict == Verdict::StartsInContact; }
  /// No pair beyond this x comes before the best. Precondition: touches().
  [[nodiscard]] double mostX() const { return best_->p_WScene.x(); }
  [[nodiscard]] bool isPast(const StartPair& pair) const {
    return touches() && pair.leastX > mostX();
  }
  [[nodiscard]] const std::optional<LinkContact>& best() const { return best_; }

  /// False if the work was spent.
  [[nodiscard]] bool lookAtTouching(std::vector<StartPair>& pairs) {
    std::sort(pairs.begin(), pairs.end(), isBefore);
    for (const StartPair& pair : pairs) {
      if (isPast(pair)) return true;
      if (!look(pair.pair)) return false;
    }
    return true;
  }

  [[nodiscard]] bool lookAtNear(std::vector<Candidate>& pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const Candidate& x, const Candidate& y) {
      if (x.nearest != y.nearest) return x.nearest < y.nearest;
      if (x.triangle != y.triangle) return x.triangle < y.triangle;
      return x.part < y.part;
    });
    for (const Candidate& pair : pairs) {
      if (pair.nearest > (best_ ? best_->separation : query_.tolerance)) return true;
      if (!look(pair)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool look(const Candidate& candidate) {
    if (query_.meter.isPartSpent(counters_)) return false;
    const MovingPair pair = pairOf(query_, candidate, states_.at(0.0), counters_);
    if (pair.gapUpper > query_.tolerance) return true;
    const LinkContact contact = contactOf(query_, candidate, pair, 0.0);
    if (!best_ || comesFirst(contact, *best_)) best_ = contact;
    return true;
  }

  const LinkQuery& query_;
  QueryCounters& counters_;
  StateCache states_;
  std::optional<LinkContact> best_;
};

/// Sorts by the least x of the scene's triangles.
void sortClusters(const LinkQuery& query, const std::vector<Candidate>& clusters,
                  std::vector<StartPair>& sorted) {
  sorted.clear();
  for (const Candidate& cluster : clusters) {
    sorted.push_back({cluster, leastX(query.scene->triangle(cluster.triangle))});
  }
  std::sort(sorted.begin(), sorted.end(), isBefore);
}

}  // namespace

std::optional<LinkContact> skinContactAtStart(const LinkQuery& query,
                                              const std::vector<Candidate>& clusters,
                                              PartScratch& scratch, QueryCounters& counters) {
  SkinStartSearch search(query, scratch, counters);
  StartLook look(query, counters);
  const LinkContact unseen = undecidedContact(query.one.link, 0.0, UndecidedReason::WorkBudget);
  scratch.nearPairs.clear();
  sortClusters(query, clusters, scratch.clusterPairs);
  const StartPair* const end = scratch.clusterPairs.data() + scratch.clusterPairs.size();
  for (const StartPair* next = scratch.clusterPairs.data(); next != end;) {
    if (look.isPast(*next)) break;
    const StartPair* const first = next;
    next += std::min(kPairsAtOnce, static_cast<std::size_t>(end - first));
    search.expand(first, next);
    const bool isDone = look.lookAtTouching(scratch.startPairs);
    // A touch stands, though a spent budget may leave one that comes before it unseen.
    if (!isDone || query.meter.isPartSpent(counters)) return look.touches() ? look.best() : unseen;
    if (look.touches()) search.keepUpTo(look.mostX());
  }
  if (!look.touches() && !look.lookAtNear(scratch.nearPairs)) return unseen;
  return look.best();
}

}  // namespace foretouch::internal
