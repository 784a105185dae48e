#include "tessellation/node_ends.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/single.h"
#include "tessellation/point_rounding.h"
#include "tessellation/swept_boxes.h"

namespace foretouch {
namespace {

/// Covers the differences and sums of an extent, in float.
constexpr float kExtentInflation = 1.0F + 0x1p-20F;

/// What no end's coordinates, added up, are above: of the box around them, seen from the origin.
float extentOf(const SweptBoxes& boxes, std::int32_t lss, const float* origin) {
  float extent = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = boxes.lower[axis][lss], high = boxes.upper[axis][lss];
    extent += std::max(std::abs(low - origin[axis]), std::abs(high - origin[axis]));
  }
  return extent * kExtentInflation;
}

}  // namespace

void NodeEnds::placeAround(const LssTable& table, const ChainNodes& nodes) {
  axes.resize(countOf(table.size()));
  extents.resize(axes.size());
  roundings.resize(axes.size());
  if (table.size() == 0) return;
  constexpr int kMiddle = kNodes / 2;
  const LinkNodes& first = nodes.link(table[0].link);
  for (int axis = 0; axis < 3; ++axis) origin[axis] = nearestFloat(first.p[axis][kMiddle]);
}

void NodeEnds::bound(const LssTable& table, const ChainNodes& nodes, const SweptBoxes& boxes) {
  // One rounding more than a point's own: the origin is taken off in double.
  const internal::PointRoundings rounding = internal::pointRoundings(nodes.bounds());
  float from[3];
  for (int axis = 0; axis < 3; ++axis) from[axis] = static_cast<float>(origin[axis]);
  for (std::int32_t i = 0; i < table.size(); ++i) {
    const double rho = std::max(table[i].rhoA, table[i].rhoB);
    extents[slotOf(i)] = extentOf(boxes, i, from);
    roundings[slotOf(i)] = internal::floatPaddedAbove(rounding.atOrigin + rounding.perLength * rho);
  }
}

}  // namespace foretouch
