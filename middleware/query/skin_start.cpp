#include "middleware/query/skin_start.h"

#include <array>
#include <cmath>
#include <utility>

#include "middleware/query/backtracking.h"

namespace foretouch::internal {
namespace {

/// Thousands of roundings of what doubles compute.
constexpr double kStartRounding = 1e-12;

/// Fills the lanes with pairs of triangles at t = 0 and keeps those that lanes do not refute.
class StartPairs {
 public:
  StartPairs(const LinkQuery& query, PartScratch& scratch, QueryCounters& counters)
      : query_(query), scratch_(scratch), counters_(counters) {
    scratch_.pairs.clear();
  }

  void add(const Candidate& pair) {
    const std::int32_t curve = scratch_.skin.curve(pair.part.index());
    scratch_.lanes.putBlend(count_, pair.laneTriangle, curve, scratch_.skin.positionPad(curve),
                            scratch_.lanes.laneTime(0.0), 0.0F);
    batch_[count_++] = pair;
    if (count_ == kTrianglePairLanes) settle();
  }

  void settle() {
    scratch_.lanes.proveBlends(scratch_.skin.curves(), count_);
    counters_.partSteps += count_;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      // What doubles find is farther from the truth by rounding.
      const double lower = scratch_.lanes.lower(lane);
      const double nearest = lower - kStartRounding * (1.0 + lower);
      if (nearest > query_.tolerance) continue;
      batch_[lane].nearest = nearest;
      scratch_.pairs.push_back(batch_[lane]);
    }
    count_ = 0;
  }

 private:
  const LinkQuery& query_;
  PartScratch& scratch_;
  QueryCounters& counters_;
  std::array<Candidate, kTrianglePairLanes> batch_;
  std::size_t count_ = 0;
};

}  // namespace

std::optional<LinkContact> skinContactAtStart(const LinkQuery& query,
                                              std::vector<Candidate>& candidates,
                                              PartScratch& scratch, QueryCounters& counters) {
  StartPairs pairs(query, scratch, counters);
  for (Candidate& cluster : candidates) {
    if (query.meter.isPartSpent(counters)) {
      return undecidedContact(query.parts.link, 0.0, UndecidedReason::WorkBudget);
    }
    Candidate pair = cluster;
    pair.laneTriangle = scratch.lanes.add(query.scene.triangle(cluster.triangle));
    pair.lss = 0;  // a cluster's number means nothing outside
    for (const std::int32_t triangle : scratch.skin.trianglesOf(cluster.lss)) {
      pair.part = Part::of(HierarchyChild::triangle(triangle));
      pairs.add(pair);
    }
  }
  pairs.settle();
  std::swap(candidates, scratch.pairs);
  return contactAtStart(query, candidates, counters);
}

}  // namespace foretouch::internal
