// middleware/pair/lane_cull.h: which leaves of the scene's tree are near which LSS of a body over
// a span of its motion: all links' frames at a few instants, boxes of all LSS, one walk of the tree
// for all of them. Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// Into how many equal slabs a motion is cut, so that polynomials follow it well enough for this
/// tolerance (m).
[[nodiscard]] int slabsOf(const LssTable& table, const ChainMotion& motion, double tolerance);

/// All references outlive it.
struct LaneCull {
  const QueryPlan& plan;
  const LssTable& table;
  const ChainMotion& motion;
  QueryMemory& scratch;

  /// Leaves the hits in the scratch, by LSS; false if there are none. `areAllAsked`: no link is
  /// left out (LaneScratch::isAsked). Keeps the nodes that the scratch has of this span.
  [[nodiscard]] bool collect(double begin, double end, bool areAllAsked,
                             QueryCounters& counters) const;

 private:
  void walk(const SweptBoxes& swept, QueryCounters& counters) const;
  void sweepSkin(QueryCounters& counters) const;
};

}  // namespace foretouch::internal
