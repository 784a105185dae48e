// middleware/pair/pair_query.h: which links of two sides that move touch each other: an avatar's
// own links, or those of two bodies. Boxes of all LSS, planes at the nodes for the pairs whose
// boxes meet, and backtracking in doubles for the few that those leave. At link or exact fidelity.
// Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/pair/lane_backtracking.h"
#include "middleware/pair/link_query.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/side_plan.h"
#include "middleware/pair/work_meter.h"

namespace foretouch::internal {

/// Pairs of LSS, i of the one side's table and j of the other's, that were found elsewhere (of
/// own links, i < j): all others are proven apart, and so are these on pieces that are not open,
/// while [0,1] is one slab.
struct FoundPairs {
  const LssIndexPair* meeting;  ///< May be as near as a contact.
  std::size_t numMeeting;
  const PlanePair*
      open;  ///< Among these; at the nodes of [0,1]. Frames, reaches and bends are not read.
  std::size_t numOpen;
};

/// The motions of both sides; the same object twice, where one chain has both.
struct PairMotions {
  const ChainMotion& one;
  const ChainMotion& other;
};

/// One query over all asked pairs of links of one step.
class PairQuery final : private Neighbours, private LaneFrames {
 public:
  /// Preconditions: the plan asks for pairs; the scratch's step began with these motions.
  PairQuery(const PairPlan& plan, const PairMotions& motions, const WorkMeter& meter,
            QueryMemory& scratch);

  /// Fills `step.pairs`.
  void run(StepContacts& step);
  /// The same for those that were found, of which only asked ones count. Once the work is spent,
  /// all that are left are undecided without a look.
  void runAmong(const FoundPairs& found, StepContacts& step);
  /// The same from `begin` in (0,1) on: what touches there starts in contact. For LSS alone. False:
  /// the motion is too long or too far away to begin anywhere but at 0, and nothing is answered.
  [[nodiscard]] bool runAmongFrom(double begin, const FoundPairs& found, StepContacts& step);

 private:
  /// A side, and its link of the pair at hand.
  struct Moving {
    const SidePlan& plan;
    const ChainMotion& motion;
    MotionEvaluator& evaluator;
    SlabCache& slabs;
    SideScratch& known;
    std::vector<float>& accelerations;
    LinkId link;
    MotionBounds bounds;

    [[nodiscard]] const LssTable& table() const { return plan.table; }
    [[nodiscard]] LinkId linkOf(std::int32_t lss) const { return plan.table[lss].link; }
    [[nodiscard]] const ChainNodes& nodes() const { return slabs.nodes(); }
  };

  [[nodiscard]] int numSlabs() const;
  void evaluate(QueryCounters& counters);
  void evaluateNodes(QueryCounters& counters);
  void sweepBoxes();
  void turnFrames();
  [[nodiscard]] bool areNodesFine(QueryCounters& counters);
  void take(const FoundPairs& found);
  void finish(StepContacts& step) const;
  [[nodiscard]] const NodeEnds& endsOf(const Moving& side) const;
  void collectMeetingPairs();
  void collectOpen(QueryCounters& counters);
  void addPlanePair(const LssIndexPair& pair);
  [[nodiscard]] float accelerationOf(std::int32_t frame, Moving& side, std::int32_t lss);
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
  [[nodiscard]] static MovingHull atFirstNode(const Moving& side, std::int32_t lss,
                                              double radiusShare);
  [[nodiscard]] static Side sideOf(const Moving& moving, LinkId frame);
  static void bound(Moving& side, LinkId frame);
  void make(PartLanes& lanes, QueryCounters& counters) override;
  [[nodiscard]] PairContact meshContact(const LinkQuery& query, QueryCounters& counters);
  void advanceAlongCurves(const LinkQuery& query, QueryCounters& counters);
  [[nodiscard]] bool advance(const LinkQuery& query, Candidate& candidate, QueryCounters& counters);
  [[nodiscard]] MovingHull alongCurve(const Moving& side, std::int32_t lss, LinkId frame, double t,
                                      double radiusShare, QueryCounters& counters);
  [[nodiscard]] const AxisCurve& curveOf(const Moving& side, std::int32_t lss, LinkId frame,
                                         QueryCounters& counters);
  [[nodiscard]] Candidate candidateOf(const LssIndexPair& pair, std::uint8_t pieces) const;
  void keep(PairContact contact, LinkId frame, StepContacts& step);
  void collect(double t, const PosedLink& posed, double reach, std::vector<Candidate>& candidates,
               QueryCounters& counters) override;

  const PairPlan plan_;
  const PairsAsked& asked_;
  const WorkMeter& meter_;
  QueryMemory& scratch_;
  PairScratch& pair_;
  bool isOneChain_;
  Moving one_, other_;
  bool stopsWhenSpent_ = false;
  double start_ = 0.0;              // nothing is asked before
  double begin_ = 0.0, end_ = 1.0;  // of the current slab
};

}  // namespace foretouch::internal
