// middleware/query/self_query.h: which of an avatar's own links touch each other: boxes of all LSS,
// planes at the nodes for the pairs whose boxes meet, and backtracking in doubles for the few that
// those leave. At link or exact fidelity. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/query/lane_backtracking.h"
#include "middleware/query/link_query.h"
#include "middleware/query/query_plan.h"
#include "middleware/query/scratch_parts.h"
#include "middleware/query/work_meter.h"

namespace foretouch::internal {

/// Pairs of LSS of the table, i < j, that somebody else has found: all others are proven apart, and
/// so are these on pieces that are not open, while [0,1] is one slab.
struct FoundPairs {
  const LssIndexPair* meeting;  ///< May be as near as a contact.
  std::size_t numMeeting;
  const PlanePair*
      open;  ///< Of these; at the nodes of [0,1]. Frames, reaches and bends are not read.
  std::size_t numOpen;
};

/// One query over all asked pairs of links of one step.
class SelfQuery final : private Neighbours, private LaneFrames {
 public:
  /// Preconditions: the plan asks for pairs; the scratch's evaluator is that of the motion.
  SelfQuery(const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
            ScratchParts& scratch);

  /// Fills `step.pairs`.
  void run(StepContacts& step);
  /// The same for those that were found, of which only asked ones count. Once the work is spent,
  /// all that are left are undecided without a look.
  void runAmong(const FoundPairs& found, StepContacts& step);
  /// The same from `begin` in (0,1) on: who touches there starts in contact. Of LSS alone. False:
  /// the motion is too long or too far away to begin anywhere but at 0, and nothing is answered.
  [[nodiscard]] bool runAmongFrom(double begin, const FoundPairs& found, StepContacts& step);

 private:
  /// One side of the pair at hand.
  struct Side {
    LinkId link = 0;
    MotionBounds bounds;
  };

  void evaluate(QueryCounters& counters);
  [[nodiscard]] const ChainNodes& nodes(QueryCounters& counters);
  [[nodiscard]] bool areNodesFine(QueryCounters& counters);
  void take(const FoundPairs& found);
  void finish(StepContacts& step) const;
  void collectOpen(QueryCounters& counters);
  void addPlanePair(const LssIndexPair& pair);
  [[nodiscard]] float accelerationOf(std::int32_t frame, std::int32_t lss);
  void tightenBends();
  void dropClosed();
  void answerPairs(StepContacts& step);
  void answerPair(std::size_t first, std::size_t count, StepContacts& step);
  [[nodiscard]] const LeftPair* leftPair() const;
  [[nodiscard]] double tolerance() const;
  [[nodiscard]] bool mayLeave(LinkQuery& query, const PairContact& contact,
                              QueryCounters& counters);
  [[nodiscard]] double startSeparation(const LinkQuery& query, QueryCounters& counters);
  [[nodiscard]] PairContact contactFrom(const LinkQuery& query, const PlanePair* pairs,
                                        std::size_t count, QueryCounters& counters);
  [[nodiscard]] std::optional<PairContact> contactAtStart(const LinkQuery& query,
                                                          QueryCounters& counters);
  [[nodiscard]] bool isNearAtStart(const LinkQuery& query, const Candidate& candidate,
                                   StateCache& states, QueryCounters& counters) const;
  [[nodiscard]] MovingHull atFirstNode(LinkId of, std::int32_t lss, double radiusShare) const;
  [[nodiscard]] LinkParts partsOf(const Side& side, const std::vector<AxisBounds>& bounds) const;
  void prepareSide(Side& side, LinkId frame, std::vector<AxisBounds>& bounds);
  void make(PartLanes& lanes, QueryCounters& counters) override;
  [[nodiscard]] PairContact meshContact(const LinkQuery& query, QueryCounters& counters);
  void advanceAlongCurves(const LinkQuery& query, QueryCounters& counters);
  [[nodiscard]] bool advance(const LinkQuery& query, Candidate& candidate, QueryCounters& counters);
  [[nodiscard]] MovingHull alongCurve(const Side& side, std::int32_t lss, LinkId frame, double t,
                                      double radiusShare, QueryCounters& counters);
  [[nodiscard]] const AxisCurve& curveOf(const Side& side, std::int32_t lss, LinkId frame,
                                         QueryCounters& counters);
  [[nodiscard]] Candidate candidateOf(const LssIndexPair& pair, std::uint8_t pieces) const;
  void keep(PairContact contact, LinkId frame, StepContacts& step);
  void collect(double t, const PosedLink& posed, double reach, std::vector<Candidate>& candidates,
               QueryCounters& counters) override;

  const QueryPlan& plan_;
  const SelfPlan& self_;
  const LssTable& table_;
  const ChainMotion& motion_;
  const WorkMeter& meter_;
  ScratchParts& scratch_;
  SelfScratch& own_;
  bool stopsWhenSpent_ = false;
  double start_ = 0.0;              // nothing is asked before
  double begin_ = 0.0, end_ = 1.0;  // of the current slab
  Side one_, other_;                // of the current pair of links
};

}  // namespace foretouch::internal
