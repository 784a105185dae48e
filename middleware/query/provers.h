// middleware/query/provers.h: other proofs that a query may be given beside its own. The product
// gives none; the reference room does (tests/reference/). Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/query_counters.h"

namespace foretouch::internal {

struct Candidate;
struct LinkQuery;
struct MovingPair;

/// Proves a pair of triangles apart, beside conservative advancement (provenFrom(), link_query.h).
class LeafProver {
 public:
  virtual ~LeafProver() = default;
  /// Up to which t, from `t` on, the candidate's pair, a triangle of the link and one of the scene,
  /// is proven to keep the query's floor; `t` itself if nothing is proven. `pair`: theirs at `t`.
  [[nodiscard]] virtual double freeUntil(const LinkQuery& query, const Candidate& candidate,
                                         const MovingPair& pair, double t,
                                         QueryCounters& counters) const = 0;
};

/// Proves all links clear at once, before any of them is asked.
class StepProver {
 public:
  virtual ~StepProver() = default;
  /// No link comes within its tolerance of the scene in the whole motion.
  [[nodiscard]] virtual bool isClear(const ChainMotion& motion, QueryCounters& counters) const = 0;
};

}  // namespace foretouch::internal
