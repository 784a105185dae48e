// middleware/query/lane_query.h: a query the fast way, slab of time by slab: culling for all links
// at once (lane_cull.h), then link by link those that are near anything (lane_link.h). Scope and
// budget are decided here. Not installed.
#pragma once

#include <cstdint>
#include <optional>

#include "middleware/pair/lane_cull.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/work_meter.h"
#include "middleware/query/body.h"
#include "middleware/query/lane_link.h"

namespace foretouch::internal {

/// One query over all links of one step, at link, exact or skinned fidelity.
class LaneQuery {
 public:
  /// `table` holds the body's LSS; `meter` started with the query. The scratch's evaluator is that
  /// of the motion.
  LaneQuery(const QueryPlan& plan, const Body& body, const LssTable& table,
            const ChainMotion& motion, const WorkMeter& meter, QueryMemory& scratch);

  /// Answers every link of `step`. With Scope::FirstOfAvatar: only the earliest contacts; all other
  /// links are AfterFirst.
  void run(StepContacts& step);

 private:
  void findWhoIsAsked(StepContacts& step);
  void leaveOut(LinkId link);
  void beginSlab(int slab, int count);
  [[nodiscard]] bool answerSlab(StepContacts& step);
  [[nodiscard]] LinkContact answer(LinkId link, float limit, QueryCounters& counters);
  [[nodiscard]] bool mayLeave(const LinkContact& contact, double share);
  [[nodiscard]] bool recedes(const LinkContact& contact) const;
  void answerObjects(LinkId link, StepContacts& step);
  void runInHalves(StepContacts& step, int slab, int slabs);
  [[nodiscard]] bool answerOpen(StepContacts& step);
  [[nodiscard]] bool isNear(LinkId link) const;
  void leaveFarFree();
  [[nodiscard]] bool keepProven(const LinkContact& undone);
  [[nodiscard]] std::optional<double> firstOf(const StepContacts& step) const;
  void leaveAfterFirst(double first, StepContacts& step) const;
  void leaveClear(StepContacts& step) const;
  void leaveUndone(StepContacts& step) const;

  const QueryPlan& plan_;
  const Body& body_;
  const LssTable& table_;
  const ChainMotion& motion_;
  LaneScratch& lanes_;
  WorkMeter meter_;
  LaneCull cull_;
  LaneLink link_;
  double begin_ = 0.0, end_ = 1.0;  // of the current slab
  bool areAllAsked_ = true;         // links, in the current slab
};

}  // namespace foretouch::internal
