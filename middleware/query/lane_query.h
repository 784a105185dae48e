// middleware/query/lane_query.h: a query the fast way. All links' frames at a few instants, boxes
// of all LSS, one walk of the scene's tree for all of them; then, for the LSS that are near
// anything, certified polynomials, advancement of clusters and of triangles in lanes; and the
// scalar code, in doubles, for the pairs that lanes could not decide. Not installed.
#pragma once

#include <cstdint>
#include <optional>

#include "middleware/query/backtracking.h"
#include "middleware/query/body.h"
#include "middleware/query/query_plan.h"
#include "middleware/query/scratch_parts.h"
#include "middleware/query/work_meter.h"
#include "middleware/scene/flat_bvh.h"

namespace foretouch::internal {

/// One query over all links of one step, at link or exact fidelity.
class LaneQuery final : private Neighbours {
 public:
  /// `table` holds the body's LSS; `meter` started with the query.
  LaneQuery(const QueryPlan& plan, const Body& body, const LssTable& table,
            const ChainMotion& motion, const WorkMeter& meter, ScratchParts& scratch);

  /// Declares that the scratch's nodes are those of this motion over [0,1], with the scene's
  /// origin.
  void keepNodes() { hasNodes_ = true; }

  /// Answers every link of `step`. With Scope::FirstOfAvatar: only the earliest contacts; all other
  /// links are AfterFirst.
  void run(StepContacts& step);

 private:
  void useTolerance(double tolerance);
  void findWhoIsAsked(StepContacts& step);
  void leaveOut(LinkId link);
  /// Of all LSS in the current slab; false if there are none.
  [[nodiscard]] bool collectHits(QueryCounters& counters);
  void sortHits();
  [[nodiscard]] bool answerSlab(StepContacts& step);
  void runInHalves(StepContacts& step, int slab, int slabs);
  [[nodiscard]] bool answerOpen(StepContacts& step);
  [[nodiscard]] bool isNear(LinkId link) const;
  void leaveFarFree();
  [[nodiscard]] bool keepProven(const LinkContact& undone);
  [[nodiscard]] std::optional<double> firstOf(const StepContacts& step) const;
  void leaveAfterFirst(double first, StepContacts& step) const;
  void leaveClear(StepContacts& step) const;
  void leaveUndone(StepContacts& step) const;
  [[nodiscard]] LinkContact answer(LinkId link, float limit, QueryCounters& counters);
  [[nodiscard]] LinkContact answerBefore(LinkId link, const LinkSurface* surface, float& best,
                                         QueryCounters& counters);
  [[nodiscard]] LinkContact undone(LinkId link) const;
  [[nodiscard]] LinkContact surfaceContact(const LinkQuery& query, bool atStart,
                                           QueryCounters& counters);
  void prepareScalar(LinkId link);
  void collect(double t, const PosedLink& posed, double reach, std::vector<Candidate>& candidates,
               QueryCounters& counters) override;
  [[nodiscard]] bool advanceLss(std::int32_t lss, float& best, QueryCounters& counters);
  void sortClusters();
  [[nodiscard]] std::size_t collectParts(std::size_t begin, std::size_t done, float best);
  void addCandidates(std::int32_t lssOfLink);
  void addCandidate(TriangleId triangle, std::int32_t lssOfLink, float gap, double freeUntil);
  [[nodiscard]] double timeOf(float u) const;
  [[nodiscard]] float lanesTimeOf(double t) const;

  const QueryPlan& plan_;
  const Body& body_;
  const LssTable& table_;
  const ChainMotion& motion_;
  const Scene& scene_;
  ScratchParts& scratch_;
  LaneScratch& lanes_;
  const FlatBvh& bvh_;
  double tolerance_;  // of the current link
  LaneTolerances tolerances_;
  WorkMeter meter_;
  LinkId link_ = 0;                 // the current one
  double begin_ = 0.0, end_ = 1.0;  // of the current slab
  bool hasNodes_ = false;
  bool areAllAsked_ = true;  // links, in the current slab
};

}  // namespace foretouch::internal
