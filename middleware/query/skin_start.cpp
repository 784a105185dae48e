#include "middleware/query/skin_start.h"

#include <array>
#include <cmath>

#include "middleware/query/backtracking.h"

namespace foretouch::internal {
namespace {

/// Thousands of roundings of what doubles compute.
constexpr double kStartRounding = 1e-12;

/// Keeps pairs at t = 0 that lanes do not refute.
class StartPairs {
 public:
  /// All of triangles, or all of parts; `kept` outlives it.
  StartPairs(const LinkQuery& query, PartScratch& scratch, bool areTriangles,
             std::vector<Candidate>& kept, QueryCounters& counters)
      : query_(query),
        scratch_(scratch),
        areTriangles_(areTriangles),
        kept_(kept),
        counters_(counters) {
    kept_.clear();
  }

  void add(Candidate pair, HierarchyChild part) {
    const std::int32_t curve = scratch_.skin.curve(part);
    scratch_.lanes.putBlend(count_, pair.laneTriangle, curve, scratch_.skin.hull(curve),
                            scratch_.lanes.laneTime(0.0), 0.0F);
    pair.part = Part::of(part);
    batch_[count_++] = pair;
    if (count_ == kTrianglePairLanes) settle();
  }

  void settle() {
    const BlendTriangle* const curves = scratch_.skin.curves();
    areTriangles_ ? scratch_.lanes.proveBlendedTriangles(curves, count_)
                  : scratch_.lanes.proveBlendedParts(curves, count_);
    counters_.partSteps += count_;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      // What doubles find is farther from the truth by rounding.
      const double lower = scratch_.lanes.lower(lane);
      const double nearest = lower - kStartRounding * (1.0 + std::abs(lower));
      if (nearest > query_.tolerance) continue;
      batch_[lane].nearest = nearest;
      kept_.push_back(batch_[lane]);
    }
    count_ = 0;
  }

 private:
  const LinkQuery& query_;
  PartScratch& scratch_;
  bool areTriangles_;
  std::vector<Candidate>& kept_;
  QueryCounters& counters_;
  std::array<Candidate, kTrianglePairLanes> batch_;
  std::size_t count_ = 0;
};

/// From clusters to their parts; false if the work was spent.
bool keepParts(const LinkQuery& query, const std::vector<Candidate>& clusters, PartScratch& scratch,
               QueryCounters& counters) {
  StartPairs pairs(query, scratch, false, scratch.pairs, counters);
  for (const Candidate& cluster : clusters) {
    if (query.meter.isPartSpent(counters)) return false;
    Candidate pair = cluster;
    pair.laneTriangle = scratch.lanes.add(query.scene.triangle(cluster.triangle));
    pair.lss = 0;  // a cluster's number means nothing outside
    const PartRange parts = scratch.skin.partsOf(cluster.lss);
    for (std::int32_t part = parts.first; part < parts.last; ++part) {
      pairs.add(pair, HierarchyChild::node(part));
    }
  }
  pairs.settle();
  return true;
}

/// From the parts to their triangles; false if the work was spent.
bool keepTriangles(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch,
                   QueryCounters& counters) {
  StartPairs pairs(query, scratch, true, candidates, counters);
  for (const Candidate& pair : scratch.pairs) {
    if (query.meter.isPartSpent(counters)) return false;
    const PartRange triangles = scratch.skin.trianglesOf(HierarchyChild::node(pair.part.index()));
    for (std::int32_t i = triangles.first; i < triangles.last; ++i) {
      pairs.add(pair, scratch.skin.triangle(i));
    }
  }
  pairs.settle();
  return true;
}

}  // namespace

std::optional<LinkContact> skinContactAtStart(const LinkQuery& query,
                                              std::vector<Candidate>& candidates,
                                              PartScratch& scratch, QueryCounters& counters) {
  if (!keepParts(query, candidates, scratch, counters) ||
      !keepTriangles(query, candidates, scratch, counters)) {
    return undecidedContact(query.parts.link, 0.0, UndecidedReason::WorkBudget);
  }
  return contactAtStart(query, candidates, counters);
}

}  // namespace foretouch::internal
