#include "middleware/world/body_boxes.h"

#include <algorithm>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

void clear(BodySweep& sweep, std::size_t numLss) {
  sweep.whole = BodyBox();
  sweep.spans.clear();
  for (std::size_t k = 0; k < 3; ++k) {
    sweep.lower[k].assign(numLss, BodyBox::kNowhere);
    sweep.upper[k].assign(numLss, -BodyBox::kNowhere);
  }
}

void add(const SweptBoxes& boxes, std::int64_t beginUs, std::int64_t endUs, BodySweep& sweep) {
  BodySweep::Span span{beginUs, endUs, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < countOf(boxes.count); ++i) {
      const float low = boxes.lower[k][i], high = boxes.upper[k][i];
      sweep.lower[k][i] = std::min(sweep.lower[k][i], low);
      sweep.upper[k][i] = std::max(sweep.upper[k][i], high);
      span.box.lower[k] = std::min(span.box.lower[k], low);
      span.box.upper[k] = std::max(span.box.upper[k], high);
    }
  }
  sweep.whole.add(span.box);
  sweep.spans.push_back(span);
}

}  // namespace

bool BodySweep::isNear(const BodySweep& other) const {
  for (std::size_t i = 0; i < lower[0].size(); ++i) {
    BodyBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = lower[k][i];
      box.upper[k] = upper[k][i];
    }
    if (!box.meets(other.whole)) continue;
    for (std::size_t j = 0; j < other.lower[0].size(); ++j) {
      bool meets = true;
      for (std::size_t k = 0; k < 3; ++k) {
        meets = meets && box.lower[k] <= other.upper[k][j] && other.lower[k][j] <= box.upper[k];
      }
      if (meets) return true;
    }
  }
  return false;
}

BodyBox BodySweep::boxIn(std::int64_t beginUs, std::int64_t endUs) const {
  BodyBox box;
  for (const Span& span : spans) {
    if (span.beginUs < endUs && span.endUs > beginUs) box.add(span.box);
  }
  return box;
}

bool BodySweep::isNearIn(const BodySweep& other, std::int64_t beginUs, std::int64_t endUs) const {
  return boxIn(beginUs, endUs).meets(other.boxIn(beginUs, endUs));
}

Result<Done> sweepBody(const WorldParts& world, BodyId body, std::int64_t fromUs, std::int64_t toUs,
                       const Eigen::Vector3d& origin, SystemPlans& plans, PieceMotions& motions,
                       SweepScratch& scratch, BodySweep& sweep) {
  std::size_t numLss = 0;
  for (const std::vector<Lss>& link : world.kindOf(body).volumes) numLss += link.size();
  clear(sweep, numLss);
  SystemSpans& spans = scratch.spans;
  spans.begin(world, body, kStillScene, fromUs, toUs);
  while (spans.next()) {
    FORETOUCH_TRY(const SystemPlan* const plan,
                  plans.planOf(world, spans, SystemQuestion::Boxes, body, kStillScene));
    spans.poses(origin, motions, scratch.poses);
    scratch.motion.assign(plan->skeleton, scratch.poses.from, scratch.poses.to);
    scratch.nodes.evaluate(scratch.motion, 0.0, 1.0, Eigen::Vector3d::Zero());
    // Each side's share of the distance within which two meet (world.md 3).
    const double margin = 0.5 * world.options.tolerance + scratch.poses.rounding;
    sweptBoxes(plan->table, scratch.motion, scratch.nodes, margin, scratch.boxes);
    add(scratch.boxes, spans.beginUs(), spans.endUs(), sweep);
  }
  return Done{};
}

}  // namespace foretouch::internal
