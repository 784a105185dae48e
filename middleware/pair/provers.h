// middleware/pair/provers.h: other ways that a query may be given beside its own. The product
// gives none; the reference room does (tests/reference/). Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/contact.h"

namespace foretouch {
struct StepContacts;
}

namespace foretouch::internal {

struct Candidate;
struct LinkQuery;
struct MovingPair;
struct QueryPlan;
struct QueryMemory;
class WorkMeter;

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

/// Answers all links of a step at once, before any of them is asked.
class StepAnswerer {
 public:
  virtual ~StepAnswerer() = default;
  /// True: every link of `step` has its answer. False: none has, and the query goes its own way.
  /// Precondition: `meter` started with the query.
  [[nodiscard]] virtual bool answers(const QueryPlan& plan, const ChainMotion& motion,
                                     const WorkMeter& meter, QueryMemory& scratch,
                                     StepContacts& step) const = 0;
};

}  // namespace foretouch::internal
