// middleware/pair/query_plan.h: a question, checked and resolved (query.h). The query's sources
// read it and never the options' alternatives. Not installed.
#pragma once

#include <memory>
#include <vector>

#include "articulated/result.h"
#include "middleware/pair/provers.h"
#include "middleware/pair/side_plan.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/blend_table.h"

namespace foretouch {
class ChainMotion;
struct StepContacts;
}  // namespace foretouch

namespace foretouch::internal {

struct QueryMemory;
class WorkMeter;

/// Whether each link has a surface of its own, fixed to it.
[[nodiscard]] inline bool isOfLinks(Fidelity fidelity) {
  return fidelity == Fidelity::Link || fidelity == Fidelity::Exact;
}

/// A side that moves, and a scene at rest.
struct QueryPlan : SidePlan {
  Scene scene;
  std::shared_ptr<const BlendTable> blends;  // at skinned fidelity; else null
  std::vector<double> margins;               // per link, if tolerances differ
  bool inLanes;                              // not pair by pair in doubles
  PairsAsked self;                           // which own links; none by default
  // What the reference room may replace (tests/reference/reference_query.h).
  std::shared_ptr<const TriangleCuller> culler;      // the scene's
  std::shared_ptr<const LeafProver> leafProver;      // null
  std::shared_ptr<const StepAnswerer> stepAnswerer;  // null
  /// Above 0: a link, or a pair of own links, that begins within its tolerance without touching is
  /// not stopped there, whichever way it moves. Its tolerance is then this share of its separation
  /// at t = 0, if that is less, and not below kMinTolerance (docs/guarantees.md 13).
  double startShare = 0.0;

  /// What lanes move: the links' own LSS, or those around clusters of a skin.
  [[nodiscard]] const LssTable& laneTable() const { return blends ? blends->table() : table; }

  /// As Query::build(). Errors as there, and a `startShare` that is not 0 to kMostStartShare, or
  /// above 0 with passSeparating or where not every link has a surface of its own in lanes.
  static Result<QueryPlan> make(const Avatar& avatar, const Scene& scene,
                                const QueryOptions& options, double startShare = 0.0);
};

/// As Query::answer(), with the meter's budget in place of the options'.
void answerStep(const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
                QueryMemory& scratch, StepContacts& step);

/// Every pair names a link of the avatar, and an object of the scene or all of them.
[[nodiscard]] Result<Done> checkedIgnored(const Avatar& avatar, const Scene& scene,
                                          const std::vector<IgnoredPair>& ignored);

}  // namespace foretouch::internal
