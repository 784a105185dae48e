#include "tessellation/swept_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "tessellation/point_rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessellation/swept_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tessellation/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

/// `x` lowered until its nearest float is not above it (lss/rounding.h, padding).
HWY_INLINE NodeVector downward(NodeLanes d, NodeVector x) {
  const NodeVector slack = hn::MulAdd(hn::Abs(x), hn::Set(d, internal::kFloatPadding),
                                      hn::Set(d, internal::kFloatUnderflow));
  return hn::Sub(x, slack);
}
HWY_INLINE NodeVector upward(NodeLanes d, NodeVector x) {
  return hn::Neg(downward(d, hn::Neg(x)));
}

/// One LSS's extents, with nodes in the lanes of a vector: least coordinates of both ends, and the
/// negatives of the largest.
struct Extents {
  alignas(64) double least[kNodes][kNodes], negated[kNodes][kNodes];
};

/// Coordinates of both ends of an LSS at the nodes from `lane` on.
struct Ends {
  NodeVector a, b;
};

HWY_INLINE Ends endsAt(NodeLanes d, const LssTable::Entry& entry, const LinkNodes& link, int axis,
                       int lane) {
  const NodeVector b = pointAt(d, link, entry.b, 0.0, axis, lane);
  // Many LSS begin at their link's origin.
  if (entry.rhoA == 0.0) return {hn::Load(d, link.p[axis] + lane), b};
  return {pointAt(d, link, entry.a, 0.0, axis, lane), b};
}

/// Stores the ends as floats relative to `shift`.
HWY_INLINE void storeEnds(NodeLanes d, const Ends& ends, double shift, int axis, int lane,
                          NodeEnds::Axis& to) {
  const hn::Rebind<float, NodeLanes> floats;
  const NodeVector from = hn::Set(d, shift);
  hn::StoreU(hn::DemoteTo(floats, hn::Sub(ends.a, from)), floats, to.a[axis] + lane);
  hn::StoreU(hn::DemoteTo(floats, hn::Sub(ends.b, from)), floats, to.b[axis] + lane);
}

/// Whether the caller needs the ends themselves: known before the loops, which are a quarter slower
/// if they ask.
enum class Keep : bool { BoxesOnly, EndsToo };

template <Keep kKeep>
HWY_INLINE void storeExtents(const LssTable::Entry& entry, const LinkNodes& link, int axis, int row,
                             Extents& extents, const double* origin, NodeEnds::Axis* kept) {
  const NodeLanes d;
  Ends ends = endsAt(d, entry, link, axis, 0);
  if constexpr (kKeep == Keep::EndsToo) storeEnds(d, ends, origin[axis], axis, 0, *kept);
  NodeVector low = hn::Min(ends.a, ends.b), high = hn::Max(ends.a, ends.b);
  for (int lane = static_cast<int>(hn::Lanes(d)); lane < kNodes;
       lane += static_cast<int>(hn::Lanes(d))) {
    ends = endsAt(d, entry, link, axis, lane);
    if constexpr (kKeep == Keep::EndsToo) storeEnds(d, ends, origin[axis], axis, lane, *kept);
    low = hn::Min(low, hn::Min(ends.a, ends.b));
    high = hn::Max(high, hn::Max(ends.a, ends.b));
  }
  hn::Store(low, d, extents.least[row]);
  hn::Store(hn::Neg(high), d, extents.negated[row]);
}

#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
/// leastOf[i] = the least of the lanes of rows[i].
HWY_INLINE void leastOfRows(const double (*rows)[kNodes], double* leastOf) {
  const NodeLanes d;
  for (int i = 0; i < kNodes; ++i) {
    leastOf[i] = hn::GetLane(hn::MinOfLanes(d, hn::Load(d, rows[i])));
  }
}
#else
/// Lanes 2i: the least of a's i-th pair of lanes; 2i+1: of b's.
HWY_INLINE NodeVector leastOfPairs(NodeLanes d, const double* a, const double* b) {
  const NodeVector first = hn::Load(d, a), second = hn::Load(d, b);
  return hn::Min(hn::InterleaveLower(d, first, second), hn::InterleaveUpper(d, first, second));
}
/// Lower half: the least of both halves of `a`; upper half: of `b`.
HWY_INLINE NodeVector leastOfHalves(NodeLanes d, NodeVector a, NodeVector b) {
  return hn::Min(hn::ConcatLowerLower(d, b, a), hn::ConcatUpperUpper(d, b, a));
}

/// leastOf[i] = the least of the lanes of rows[i], eight rows folded together: a quarter of the
/// shuffles of row by row.
HWY_INLINE void leastOfRows(const double (*rows)[kNodes], double* leastOf) {
  const NodeLanes d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(NodeLanes()));
  if constexpr (kLanes == 2) {
    for (int i = 0; i < kNodes; i += 2) {
      hn::Store(leastOfPairs(d, rows[i], rows[i + 1]), d, leastOf + i);
    }
  } else if constexpr (kLanes == 4) {
    for (int i = 0; i < kNodes; i += 4) {
      hn::Store(leastOfHalves(d, leastOfPairs(d, rows[i], rows[i + 1]),
                              leastOfPairs(d, rows[i + 2], rows[i + 3])),
                d, leastOf + i);
    }
  } else {
    const NodeVector g =
        leastOfHalves(d, leastOfPairs(d, rows[0], rows[1]), leastOfPairs(d, rows[4], rows[5]));
    const NodeVector h =
        leastOfHalves(d, leastOfPairs(d, rows[2], rows[3]), leastOfPairs(d, rows[6], rows[7]));
    // Blocks of two lanes: g holds rows 0, 1 in its first two and 4, 5 in its last, h the others.
    hn::Store(hn::Min(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(h), g),
                      hn::OddEvenBlocks(h, hn::SwapAdjacentBlocks(g))),
              d, leastOf);
  }
}
#endif

template <Keep kKeep>
HWY_INLINE void boxesKeeping(const LssTable::Entry* entries, int count, const LinkNodes* links,
                             const double* growths, float* const* lower, float* const* upper,
                             const double* origin, NodeEnds::Axis* kept) {
  const NodeLanes d;
  const hn::Rebind<float, NodeLanes> floats;
  Extents extents[3];
  alignas(64) double least[kNodes], negated[kNodes];
  for (int first = 0; first < count; first += kNodes) {
    for (int i = 0; i < kNodes; ++i) {
      // Lanes beyond the last LSS repeat it.
      const int lss = first + i < count ? first + i : count - 1;
      const LssTable::Entry& entry = entries[lss];
      const LinkNodes& link = links[entry.link];
      for (int axis = 0; axis < 3; ++axis) {
        storeExtents<kKeep>(entry, link, axis, i, extents[axis], origin,
                            kKeep == Keep::EndsToo ? kept + lss : nullptr);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      leastOfRows(extents[axis].least, least);
      leastOfRows(extents[axis].negated, negated);
      for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
        const NodeVector grown = hn::LoadU(d, growths + first + lane);
        const NodeVector low = hn::Sub(hn::Load(d, least + lane), grown);
        const NodeVector high = hn::Sub(grown, hn::Load(d, negated + lane));
        hn::Store(hn::DemoteTo(floats, downward(d, low)), floats, lower[axis] + first + lane);
        hn::Store(hn::DemoteTo(floats, upward(d, high)), floats, upper[axis] + first + lane);
      }
    }
  }
}

/// Boxes of `count` LSS; `growths` are how far each reaches beyond the ends at the nodes.
/// `lower`, `upper`: three arrays each, `growths` one, with room for a multiple of kNodes. `kept`:
/// room for the ends themselves, relative to `origin`; or null.
void boxesOf(const LssTable::Entry* entries, int count, const LinkNodes* links,
             const double* growths, float* const* lower, float* const* upper, const double* origin,
             NodeEnds::Axis* kept) {
  if (kept != nullptr) {
    boxesKeeping<Keep::EndsToo>(entries, count, links, growths, lower, upper, origin, kept);
  } else {
    boxesKeeping<Keep::BoxesOnly>(entries, count, links, growths, lower, upper, nullptr, nullptr);
  }
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(boxesOf);

using internal::kInflation;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// How far LSS may reach, beyond their ends at both instants, between two instants `gap` apart.
class Growth {
 public:
  Growth(const ChainMotion& motion, const ChainNodes& nodes, double gap)
      : sums_(&motion.sums(0)),
        sagittas_(gap * gap / 8.0 * kInflation),
        rounding_(internal::pointRoundings(nodes.bounds())) {}

  /// The margin plus the rounding of the origin.
  [[nodiscard]] double wholeMargin(double margin) const { return margin + rounding_.atOrigin; }

  [[nodiscard]] double of(const LssTable::Entry& entry, double wholeMargin) const {
    const double rho = std::max(entry.rhoA, entry.rhoB);
    return (sums_[entry.link].accelerationAt(rho) * sagittas_ +
            (rounding_.perLength * rho + (entry.radius + wholeMargin))) *
           kInflation;
  }

 private:
  const ChainSums* sums_;  // per link
  double sagittas_;        // per acceleration
  internal::PointRoundings rounding_;
};

void computeBoxes(const LssTable& table, const ChainNodes& nodes, const double* growths,
                  SweptBoxes& boxes, NodeEnds* ends, const NodeEnds* beside = nullptr) {
  if (ends != nullptr) ends->placeAround(table, nodes);
  if (ends != nullptr && beside != nullptr) std::copy_n(beside->origin, 3, ends->origin);
  HWY_DYNAMIC_DISPATCH(boxesOf)
  (table.data(), table.size(), &nodes.link(0), growths, boxes.lower, boxes.upper,
   ends != nullptr ? ends->origin : nullptr, ends != nullptr ? ends->axes.data() : nullptr);
}

/// Covers the differences and sums of an extent, in float.
constexpr float kExtentInflation = 1.0F + 0x1p-20F;

/// What no end's coordinates, added up, are above: from the box around them, seen from the origin.
float extentOf(const SweptBoxes& boxes, std::int32_t lss, const float* origin) {
  float extent = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = boxes.lower[axis][lss], high = boxes.upper[axis][lss];
    extent += std::max(std::abs(low - origin[axis]), std::abs(high - origin[axis]));
  }
  return extent * kExtentInflation;
}

/// Fills the ends' extents and roundings. The boxes contain the ends.
void boundEnds(const LssTable& table, const ChainNodes& nodes, const SweptBoxes& boxes,
               NodeEnds& ends) {
  // One rounding more than a point's own: the origin is taken off in double.
  const internal::PointRoundings rounding = internal::pointRoundings(nodes.bounds());
  float from[3];
  for (int axis = 0; axis < 3; ++axis) from[axis] = static_cast<float>(ends.origin[axis]);
  for (std::int32_t i = 0; i < table.size(); ++i) {
    const double rho = std::max(table[i].rhoA, table[i].rhoB);
    ends.extents[slotOf(i)] = extentOf(boxes, i, from);
    ends.roundings[slotOf(i)] =
        internal::floatPaddedAbove(rounding.atOrigin + rounding.perLength * rho);
  }
}

}  // namespace

double widestGap(const ChainNodes& nodes) {
  double gap = 0.0;
  for (int k = 1; k < kNodes; ++k) gap = std::max(gap, nodes.instant(k) - nodes.instant(k - 1));
  return gap;
}

void SweptBoxes::resize(std::int32_t newCount) {
  makeRoom(newCount);
  emptyFrom(0);
}

void SweptBoxes::makeRoom(std::int32_t newCount) {
  count = newCount;
  capacity = (newCount + kPadding - 1) / kPadding * kPadding;
  const auto blocks = static_cast<std::size_t>(capacity / kPadding);
  if (storage_.size() < 6 * blocks) storage_.resize(6 * blocks);
  if (growths_.size() < blocks * kPadding) growths_.resize(blocks * kPadding);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = storage_[axis * blocks].lanes;
    upper[axis] = storage_[(axis + 3) * blocks].lanes;
  }
}

void SweptBoxes::emptyFrom(std::int32_t first) {
  for (int axis = 0; axis < 3; ++axis) {
    for (std::int32_t i = first; i < capacity; ++i) {
      lower[axis][i] = kInfinity;
      upper[axis][i] = -kInfinity;
    }
  }
}

void sweptBoxes(const LssTable& table, const ChainMotion& motion, const ChainNodes& nodes,
                double margin, SweptBoxes& boxes, NodeEnds* ends, const NodeEnds* beside) {
  FORETOUCH_ASSERT(table.numLinks() == nodes.numLinks() && nodes.numLinks() == motion.numLinks());
  boxes.makeRoom(table.size());
  if (table.size() == 0) return;
  const Growth growth(motion, nodes, widestGap(nodes));
  const double whole = growth.wholeMargin(margin);
  double* const growths = boxes.growths_.data();
  for (std::int32_t i = 0; i < table.size(); ++i) growths[i] = growth.of(table[i], whole);
  computeBoxes(table, nodes, growths, boxes, ends, beside);
  boxes.emptyFrom(table.size());
  if (ends != nullptr) boundEnds(table, nodes, boxes, *ends);
}

void sweptBoxes(const LssTable& table, const ChainMotion& motion, const ChainNodes& nodes,
                const std::vector<double>& margins, SweptBoxes& boxes, NodeEnds* ends) {
  FORETOUCH_ASSERT(table.numLinks() == nodes.numLinks() && nodes.numLinks() == motion.numLinks());
  FORETOUCH_ASSERT(margins.size() == countOf(table.numLinks()));
  boxes.makeRoom(table.size());
  if (table.size() == 0) return;
  const Growth growth(motion, nodes, widestGap(nodes));
  double* const growths = boxes.growths_.data();
  for (std::int32_t i = 0; i < table.size(); ++i) {
    const double margin = margins[slotOf(table[i].link)];
    growths[i] = growth.of(table[i], growth.wholeMargin(margin));
  }
  computeBoxes(table, nodes, growths, boxes, ends);
  boxes.emptyFrom(table.size());
  if (ends != nullptr) boundEnds(table, nodes, boxes, *ends);
}

}  // namespace foretouch
#endif
