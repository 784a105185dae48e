#include "tessellation/node_ends.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/single.h"
#include "tessellation/point_rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessellation/node_ends.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tessellation/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

HWY_INLINE void placeEnd(const LinkNodes& link, const double* p_L, const double* origin,
                         float (*end)[kNodes]) {
  const NodeLanes d;
  const hn::Rebind<float, NodeLanes> floats;
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
      const NodeVector place = pointAt(d, link, p_L, origin[axis], axis, lane);
      hn::StoreU(hn::DemoteTo(floats, place), floats, end[axis] + lane);
    }
  }
}

void placeEnds(const LssTable::Entry* entries, int count, const LinkNodes* links,
               const double* origin, NodeEnds::Axis* axes) {
  for (int i = 0; i < count; ++i) {
    const LinkNodes& link = links[entries[i].link];
    placeEnd(link, entries[i].a, origin, axes[i].a);
    placeEnd(link, entries[i].b, origin, axes[i].b);
  }
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(placeEnds);

/// Covers the three differences and two sums of an extent, in float.
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

void nodeEnds(const LssTable& table, const ChainNodes& nodes, const SweptBoxes& boxes,
              NodeEnds& ends) {
  const auto count = countOf(table.size());
  ends.axes.resize(count);
  ends.extents.resize(count);
  ends.roundings.resize(count);
  if (count == 0) return;
  constexpr int kMiddle = kNodes / 2;
  const LinkNodes& first = nodes.link(table[0].link);
  float origin[3];
  for (int axis = 0; axis < 3; ++axis) {
    ends.origin[axis] = nearestFloat(first.p[axis][kMiddle]);
    origin[axis] = static_cast<float>(ends.origin[axis]);
  }
  HWY_DYNAMIC_DISPATCH(placeEnds)
  (table.data(), table.size(), &nodes.link(0), ends.origin, ends.axes.data());
  const internal::PointRoundings rounding = internal::pointRoundings(nodes.bounds());
  for (std::int32_t i = 0; i < table.size(); ++i) {
    const double rho = std::max(table[i].rhoA, table[i].rhoB);
    ends.extents[slotOf(i)] = extentOf(boxes, i, origin);
    ends.roundings[slotOf(i)] =
        internal::floatPaddedAbove(rounding.atOrigin + rounding.perLength * rho);
  }
}

}  // namespace foretouch
#endif
