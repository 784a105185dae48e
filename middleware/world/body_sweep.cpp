#include "middleware/world/body_sweep.h"

#include <algorithm>
#include <utility>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/lanes/node_planes.h"

namespace foretouch::internal {
namespace {

constexpr std::size_t kRowBlock = SweptBoxes::kPadding;

/// The best of a multiple of kRowBlock floats, that many at once.
template <typename Better>
float bestOf(const std::vector<float>& row, const Better& better) {
  float best[kRowBlock];
  std::copy_n(row.data(), kRowBlock, best);
  for (std::size_t first = kRowBlock; first < row.size(); first += kRowBlock) {
    for (std::size_t k = 0; k < kRowBlock; ++k) best[k] = better(best[k], row[first + k]);
  }
  for (std::size_t half = kRowBlock / 2; half > 0; half /= 2) {
    for (std::size_t k = 0; k < half; ++k) best[k] = better(best[k], best[half + k]);
  }
  return best[0];
}
float leastOf(const std::vector<float>& row) {
  if (row.empty()) return BodyBox::kNowhere;
  return bestOf(row, [](float x, float y) { return x < y ? x : y; });
}
float largestOf(const std::vector<float>& row) {
  if (row.empty()) return -BodyBox::kNowhere;
  return bestOf(row, [](float x, float y) { return x < y ? y : x; });
}

}  // namespace

void SpanSweep::fill(const LssTable& table, const ChainMotion& motion, SlabScratch& slab,
                     const Eigen::Vector3d& from, double cut) {
  const SweptBoxes& boxes = slab.boxes;
  origin = from + slab.nodes.origin();
  numLss = boxes.count;
  for (std::size_t k = 0; k < 3; ++k) {
    lower[k].assign(boxes.lower[k], boxes.lower[k] + boxes.capacity);
    upper[k].assign(boxes.upper[k], boxes.upper[k] + boxes.capacity);
    box.lower[k] = leastOf(lower[k]);
    box.upper[k] = largestOf(upper[k]);
  }
  turn = table.size() > 0 ? static_cast<float>(motion.sums(table[0].link).angularSpeed) : 0.0F;
  // Both have room for every body's.
  std::swap(ends, slab.ends);
  slab.areBoxesOfNodes = false;
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

void SpanSweep::makeRoom(std::size_t mostLss) {
  ends.axes.reserve(mostLss);
  ends.extents.reserve(mostLss);
  ends.roundings.reserve(mostLss);
}

const SpanSweep& BodySweep::at(std::int64_t utimeUs) const {
  for (const SpanPart& part : parts) {
    if (part.beginUs <= utimeUs && utimeUs < part.endUs) return spans[part.sweep];
  }
  FORETOUCH_ASSERT(false);
  return spans.front();
}

std::ptrdiff_t BodySweep::placeOf(std::int64_t episodeUs, std::int64_t beginUs, std::int64_t endUs,
                                  SystemQuestion question) const {
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SpanSweep& span = spans[i];
    if (span.isWhole && span.question == question && span.episodeUs == episodeUs &&
        span.beginUs == beginUs && span.endUs == endUs) {
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
