#include "middleware/pair/lane_cull.h"

#include <algorithm>
#include <limits>

#include "lss/index.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// Polynomials that are off by less than this share of the tolerance, or by this (m), decide almost
/// as well as exact ones: their radius includes the error, and more slabs cost more.
constexpr double kInterpolationShare = 1.0 / 64.0;
constexpr double kLeastInterpolationError = 4e-6;

/// An empty box, which meets nothing.
void closeBox(SweptBoxes& boxes, std::int32_t lss) {
  for (int axis = 0; axis < 3; ++axis) {
    boxes.lower[axis][lss] = std::numeric_limits<float>::infinity();
    boxes.upper[axis][lss] = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

int slabsOf(const LssTable& table, const ChainMotion& motion, double tolerance) {
  return slabsFor(table, motion,
                  std::max(kInterpolationShare * tolerance, kLeastInterpolationError));
}

bool LaneCull::collect(double begin, double end, bool areAllAsked, QueryCounters& counters) const {
  LaneScratch& lanes = scratch.lanes;
  lanes.evaluateNodes(motion, begin, end, plan.scene.parts().origin, counters);
  SlabScratch& slab = lanes.slab();
  NodeEnds* const ends = plan.self.isAsked() ? &slab.ends : nullptr;
  if (plan.blends) {
    sweepSkin(counters);
  } else if (plan.margins.empty()) {
    sweptBoxes(table, motion, slab.nodes, plan.tolerances.least, slab.boxes, ends);
  } else {
    sweptBoxes(table, motion, slab.nodes, plan.margins, slab.boxes, ends);
  }
  slab.areBoxesOfNodes = areAllAsked && &table == &plan.table;
  for (std::int32_t lss = 0; !areAllAsked && lss < table.size(); ++lss) {
    if (lanes.isAsked[slotOf(table[lss].link)] == 0) closeBox(slab.boxes, lss);
  }
  walk(slab.boxes, counters);
  if (lanes.hits.empty()) return false;
  lanes.sortByBox(countOf(table.size()));
  return true;
}

void LaneCull::walk(const SweptBoxes& swept, QueryCounters& counters) const {
  scratch.lanes.hits.clear();
  BoxLanes boxes;
  boxes.count = swept.count;
  for (int axis = 0; axis < 3; ++axis) {
    boxes.lower[axis] = swept.lower[axis];
    boxes.upper[axis] = swept.upper[axis];
  }
  plan.culler->collectLeaves(boxes, scratch.lanes.hits, counters.nodes, counters.leaves);
}

/// Boxes of the clusters of those links whose own boxes meet a leaf; the others' are empty.
void LaneCull::sweepSkin(QueryCounters& counters) const {
  LaneScratch& lanes = scratch.lanes;
  SkinLanes& skin = lanes.parts.skin;
  const double margin = plan.tolerances.least;
  skin.beginSpan(plan.options.skin->parts(), *plan.blends, motion, lanes.nodes());
  walk(skin.linkBoxes(margin), counters);
  lanes.isNear.assign(countOf(table.numLinks()), 0);
  for (const LeafHit& hit : lanes.hits) lanes.isNear[hit.box] = lanes.isAsked[hit.box];
  lanes.slab().boxes.resize(table.size());
  for (LinkId link = 0; link < table.numLinks(); ++link) {
    if (lanes.isNear[slotOf(link)] == 0) continue;
    for (std::int32_t lss = table.first(link); lss < table.first(link + 1); ++lss) {
      skin.addBox(lss, margin, lanes.slab().boxes);
      ++counters.partSteps;
    }
  }
}

}  // namespace foretouch::internal
