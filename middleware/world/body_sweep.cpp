#include "middleware/world/body_sweep.h"

#include <algorithm>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/lanes/node_planes.h"

namespace foretouch::internal {

void SpanSweep::fill(const LssTable& table, const ChainMotion& motion, const SlabScratch& slab,
                     const Eigen::Vector3d& from, double cut) {
  const SweptBoxes& boxes = slab.boxes;
  origin = from + slab.nodes.origin();
  numLss = boxes.count;
  box = BodyBox();
  for (std::size_t k = 0; k < 3; ++k) {
    lower[k].assign(boxes.lower[k], boxes.lower[k] + boxes.capacity);
    upper[k].assign(boxes.upper[k], boxes.upper[k] + boxes.capacity);
    for (std::size_t i = 0; i < countOf(numLss); ++i) {
      box.lower[k] = std::min(box.lower[k], lower[k][i]);
      box.upper[k] = std::max(box.upper[k], upper[k][i]);
    }
  }
  ends = slab.ends;
  bends.resize(countOf(numLss));
  reaches.resize(bends.size());
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const LssTable::Entry& entry = table[static_cast<std::int32_t>(i)];
    bends[i] =
        floatPaddedAbove(motion.sums(entry.link).accelerationAt(std::max(entry.rhoA, entry.rhoB)));
    reaches[i] =
        floatPaddedAbove(entry.radius + kNodePlaneRounding * static_cast<double>(ends.extents[i]) +
                         static_cast<double>(ends.roundings[i]) + cut);
  }
  const double gap = widestGap(slab.nodes);
  widestSagitta = floatPaddedAbove(gap * gap / 8.0 * kInflation);
}

const SpanSweep& BodySweep::at(std::int64_t utimeUs) const {
  for (const SpanPart& part : parts) {
    if (part.beginUs <= utimeUs && utimeUs < part.endUs) return spans[part.sweep];
  }
  FORETOUCH_ASSERT(false);
  return spans.front();
}

std::ptrdiff_t BodySweep::placeOfPiece(std::int64_t beginUs, std::int64_t endUs) const {
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SpanSweep& span = spans[i];
    if (span.isWhole && span.beginUs == beginUs && span.endUs == endUs) {
      return static_cast<std::ptrdiff_t>(i);
    }
  }
  return -1;
}

std::size_t BodySweep::freePlace(std::uint64_t window) {
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (spans[i].window != window) return i;
  }
  spans.emplace_back();
  return spans.size() - 1;
}

}  // namespace foretouch::internal
