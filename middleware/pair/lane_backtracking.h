// middleware/pair/lane_backtracking.h: backtracking through a link's LSS hierarchy in lanes: many
// pairs of a part and a scene's triangle at once, each at its own instant; contact is decided in
// doubles alone. The fast form of backtracking.h for exact and skinned fidelity. Not installed.
#pragma once

#include <vector>

#include "middleware/pair/link_query.h"
#include "middleware/pair/part_pairs.h"

namespace foretouch::internal {

/// Below this share of the tolerance lanes give a pair up, to the parts below or to doubles, which
/// will mostly find contact: what lanes prove is a little less than the truth.
inline constexpr double kHandOverShare = 0.75;

/// Makes the lanes' frames when they are first needed: most that touch at the start need none.
class LaneFrames {
 public:
  virtual void make(PartLanes& lanes, QueryCounters& counters) = 0;

 protected:
  ~LaneFrames() = default;
};

/// As backtrack(), for exact and skinned fidelity and for candidates in the span of
/// `scratch.lanes`, to which it adds their triangles as needed. Every pair's instants depend on
/// that pair alone, so the reported contact does not depend on order, unless the current part of
/// the budget runs out before all pairs are done. `frames`: the lanes', or null if they are
/// there.
[[nodiscard]] PairContact backtrackInLanes(const LinkQuery& query,
                                           std::vector<Candidate>& candidates, PartScratch& scratch,
                                           QueryCounters& counters, LaneFrames* frames = nullptr);

/// As nearestContact().
[[nodiscard]] LinkContact nearestInLanes(const LinkQuery& query, const LinkContact& contact,
                                         std::vector<Candidate>& candidates, PartScratch& scratch,
                                         QueryCounters& counters);

}  // namespace foretouch::internal
