#include "middleware/lanes/near_bins.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/near_bins.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lss/double_lanes-inl.h"
#include "middleware/lanes/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// No fused operation in here: the doubles of near_places.cpp have none, and sum in this order.

template <class V>
HWY_INLINE V plainDot(const Point<V>& p, const Point<V>& q) {
  return hn::Add(hn::Add(hn::Mul(p.x, q.x), hn::Mul(p.y, q.y)), hn::Mul(p.z, q.z));
}
template <class V>
HWY_INLINE Point<V> plainCross(const Point<V>& p, const Point<V>& q) {
  return {hn::Sub(hn::Mul(p.y, q.z), hn::Mul(p.z, q.y)),
          hn::Sub(hn::Mul(p.z, q.x), hn::Mul(p.x, q.z)),
          hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x))};
}
/// p + s q
template <class V>
HWY_INLINE Point<V> plainAlong(const Point<V>& p, V s, const Point<V>& q) {
  return {hn::Add(p.x, hn::Mul(s, q.x)), hn::Add(p.y, hn::Mul(s, q.y)),
          hn::Add(p.z, hn::Mul(s, q.z))};
}
/// s p + t q
template <class V>
HWY_INLINE Point<V> plainMix(V s, const Point<V>& p, V t, const Point<V>& q) {
  return plainAlong(scaled(s, p), t, q);
}
/// x / y within [0, 1]; 0 where y is not above 0.
template <class V>
HWY_INLINE V shareOf(V x, V y) {
  const hn::DFromV<V> d;
  return hn::IfThenElseZero(hn::Gt(y, hn::Zero(d)), clamp01(hn::Div(x, y)));
}

/// The axis and the triangles of some lanes, relative to each triangle's first vertex.
template <class D>
struct PlacePairs {
  using V = hn::Vec<D>;
  Point<V> a, b, axis, vertex[3], edge[3], normal;
  V squaredAxis, squaredEdge[3], squaredNormal;
  hn::Mask<D> isFlatEdge[3], isFlatVertex[3], isStraightVertex[3];
};

template <class D>
HWY_INLINE PlacePairs<D> placePairs(D d, const PlacedLss& lss, const PlaceBlock& block,
                                    std::size_t lane) {
  const auto corner = [&](int k) HWY_ATTR {
    return Point<hn::Vec<D>>{hn::Load(d, block.vertex[k][0] + lane),
                             hn::Load(d, block.vertex[k][1] + lane),
                             hn::Load(d, block.vertex[k][2] + lane)};
  };
  const auto end = [&](const double(&p)[3]) HWY_ATTR {
    return Point<hn::Vec<D>>{hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])};
  };
  PlacePairs<D> pairs;
  const auto first = corner(0);
  pairs.a = sub(end(lss.a), first);
  pairs.b = sub(end(lss.b), first);
  pairs.axis = sub(pairs.b, pairs.a);
  pairs.squaredAxis = plainDot(pairs.axis, pairs.axis);
  pairs.vertex[0] = sub(first, first);
  pairs.vertex[1] = sub(corner(1), first);
  pairs.vertex[2] = sub(corner(2), first);
  const hn::RebindToSigned<D> di;
  const auto flat = hn::Load(di, block.flat + lane);
  for (int k = 0; k < 3; ++k) {
    pairs.edge[k] = sub(pairs.vertex[(k + 1) % 3], pairs.vertex[k]);
    pairs.squaredEdge[k] = plainDot(pairs.edge[k], pairs.edge[k]);
    pairs.isFlatEdge[k] = hn::RebindMask(d, hn::TestBit(flat, hn::Set(di, 1LL << k)));
    pairs.isFlatVertex[k] = hn::RebindMask(d, hn::TestBit(flat, hn::Set(di, 8LL << k)));
    pairs.isStraightVertex[k] = hn::AndNot(
        pairs.isFlatVertex[k], hn::RebindMask(d, hn::TestBit(flat, hn::Set(di, 64LL << k))));
  }
  pairs.normal = plainCross(pairs.vertex[1], pairs.vertex[2]);
  pairs.squaredNormal = plainDot(pairs.normal, pairs.normal);
  return pairs;
}

/// For a squared sine that is compared with a bound: far above rounding.
constexpr double kMore = 1.0 + 1e-6;

/// A place in every lane.
template <class D>
struct LanePlaces {
  hn::Vec<D> squared;      ///< That of the distance.
  Point<hn::Vec<D>> away;  ///< From the triangle to the axis.
  hn::Vec<D> along;        ///< Where on the axis.
  hn::Mask<D> isOnFace;
  hn::Mask<D> isFlat;         ///< On an edge or a vertex inside a flat surface.
  hn::Mask<D> isStraight[3];  ///< On that vertex, where a corner goes on straight.
};

template <class D>
HWY_INLINE hn::Mask<D> isAtFirst(D d, hn::Vec<D> share) {
  return hn::Lt(share, hn::Set(d, kAtEnd));
}
template <class D>
HWY_INLINE hn::Mask<D> isAtLast(D d, hn::Vec<D> share) {
  return hn::Gt(share, hn::Set(d, 1.0 - kAtEnd));
}

/// Whether what is at a share of edge k is inside a flat surface.
template <class D>
HWY_INLINE hn::Mask<D> isFlatAt(D d, const PlacePairs<D>& pairs, int k, hn::Vec<D> share) {
  const auto isFirst = isAtFirst(d, share), isLast = isAtLast(d, share);
  return hn::Or(hn::AndNot(hn::Or(isFirst, isLast), pairs.isFlatEdge[k]),
                hn::Or(hn::And(isFirst, pairs.isFlatVertex[k]),
                       hn::And(isLast, pairs.isFlatVertex[(k + 1) % 3])));
}

/// Finds the places at a share of edge k that are on straight vertices.
template <class D>
HWY_INLINE void setStraight(D d, const PlacePairs<D>& pairs, int k, hn::Vec<D> share,
                            hn::Mask<D> places, LanePlaces<D>& place) {
  const int next = (k + 1) % 3, last = (k + 2) % 3;
  const auto choose = [&](int vertex, hn::Mask<D> there) HWY_ATTR {
    place.isStraight[vertex] =
        hn::Or(hn::And(places, hn::And(there, pairs.isStraightVertex[vertex])),
               hn::AndNot(places, place.isStraight[vertex]));
  };
  choose(k, isAtFirst(d, share));
  choose(next, isAtLast(d, share));
  place.isStraight[last] = hn::AndNot(places, place.isStraight[last]);
}

/// The foot of p on the face, where it has one; else the squared distance is infinite. `isRim`: it
/// is the edges', too.
template <class D>
HWY_INLINE LanePlaces<D> footOf(D d, const PlacePairs<D>& pairs, const Point<hn::Vec<D>>& p,
                                hn::Mask<D>& isRim) {
  using V = hn::Vec<D>;
  const V zero = hn::Zero(d), nn = pairs.squaredNormal, atEnd = hn::Set(d, kAtEnd);
  const Point<V>&e1 = pairs.vertex[1], &e2 = pairs.vertex[2];
  const V beta = hn::Div(plainDot(plainCross(p, e2), pairs.normal), nn);
  const V gamma = hn::Div(plainDot(plainCross(e1, p), pairs.normal), nn);
  const V alpha = hn::Sub(hn::Sub(hn::Set(d, 1.0), beta), gamma);
  const auto isInside = hn::And(hn::And(hn::Gt(nn, zero), hn::Ge(beta, zero)),
                                hn::And(hn::Ge(gamma, zero), hn::Ge(alpha, zero)));
  isRim = hn::And(isInside,
                  hn::Or(hn::Lt(alpha, atEnd), hn::Or(hn::Lt(beta, atEnd), hn::Lt(gamma, atEnd))));
  LanePlaces<D> place;
  place.away = sub(p, plainMix(beta, e1, gamma, e2));
  place.squared = hn::IfThenElse(isInside, plainDot(place.away, place.away), hn::Inf(d));
  place.along = zero;
  place.isOnFace = isInside;
  place.isFlat = hn::Gt(zero, zero);
  for (auto& isStraight : place.isStraight) isStraight = place.isFlat;
  return place;
}

/// The sphere at an end of the axis.
template <class D>
HWY_INLINE LanePlaces<D> placeOfEnd(D d, const PlacePairs<D>& pairs, const Point<hn::Vec<D>>& p,
                                    double along, hn::Mask<D>& isRim) {
  using V = hn::Vec<D>;
  LanePlaces<D> best = footOf(d, pairs, p, isRim);
  best.along = hn::Set(d, along);
  if (hn::AllTrue(d, best.isOnFace)) return best;
  for (int k = 0; k < 3; ++k) {
    const Point<V> w = sub(p, pairs.vertex[k]);
    const V t = shareOf(plainDot(pairs.edge[k], w), pairs.squaredEdge[k]);
    const Point<V> away = sub(p, plainAlong(pairs.vertex[k], t, pairs.edge[k]));
    const V squared = plainDot(away, away);
    const auto isNearer = hn::AndNot(best.isOnFace, hn::Lt(squared, best.squared));
    best.squared = hn::IfThenElse(isNearer, squared, best.squared);
    best.away = select(isNearer, away, best.away);
    best.isFlat =
        hn::Or(hn::And(isNearer, isFlatAt(d, pairs, k, t)), hn::AndNot(isNearer, best.isFlat));
    setStraight(d, pairs, k, t, isNearer, best);
  }
  return best;
}

/// The axis and edge k. `isInner`: at inner points of both. `isTrusted`: they are not nearly
/// parallel.
template <class D>
HWY_INLINE LanePlaces<D> placeOfEdge(D d, const PlacedLss& lss, const PlacePairs<D>& pairs, int k,
                                     hn::Mask<D>& isInner, hn::Mask<D>& isTrusted) {
  using V = hn::Vec<D>;
  const Point<V>& edge = pairs.edge[k];
  const V squaredEdge = pairs.squaredEdge[k];
  const V mixed = plainDot(pairs.axis, edge), scale = hn::Mul(pairs.squaredAxis, squaredEdge);
  const V determinant = hn::Sub(scale, hn::Mul(mixed, mixed));
  const Point<V> w = sub(pairs.a, pairs.vertex[k]);
  const V onAxis = plainDot(pairs.axis, w), onEdge = plainDot(edge, w);
  isTrusted = hn::Gt(determinant, hn::Mul(hn::Set(d, lss.nearParallel), scale));
  V s = shareOf(hn::Sub(hn::Mul(mixed, onEdge), hn::Mul(squaredEdge, onAxis)), determinant);
  const V t = shareOf(hn::Add(onEdge, hn::Mul(s, mixed)), squaredEdge);
  s = shareOf(hn::Sub(hn::Mul(t, mixed), onAxis), pairs.squaredAxis);
  LanePlaces<D> place;
  place.away = sub(plainAlong(pairs.a, s, pairs.axis), plainAlong(pairs.vertex[k], t, edge));
  place.squared = plainDot(place.away, place.away);
  place.along = s;
  place.isOnFace = hn::Gt(place.squared, hn::Inf(d));
  place.isFlat = isFlatAt(d, pairs, k, t);
  for (auto& isStraight : place.isStraight) isStraight = place.isOnFace;
  setStraight(d, pairs, k, t, hn::Not(place.isOnFace), place);
  const auto isAtAny =
      hn::Or(hn::Or(isAtFirst(d, s), isAtLast(d, s)), hn::Or(isAtFirst(d, t), isAtLast(d, t)));
  isInner = hn::AndNot(isAtAny, isTrusted);
  return place;
}

/// Whether the axis passes through the face.
template <class D>
HWY_INLINE hn::Mask<D> passesThrough(D d, const PlacePairs<D>& pairs) {
  using V = hn::Vec<D>;
  const V zero = hn::Zero(d);
  const V heightA = plainDot(pairs.normal, pairs.a), heightB = plainDot(pairs.normal, pairs.b);
  const auto crosses =
      hn::And(hn::Xor(hn::Gt(heightA, zero), hn::Gt(heightB, zero)), hn::Ne(heightA, heightB));
  if (hn::AllFalse(d, crosses)) return crosses;
  const V s = clamp01(hn::Div(heightA, hn::Sub(heightA, heightB)));
  hn::Mask<D> isRim;
  const auto foot = footOf(d, pairs, plainAlong(pairs.a, s, pairs.axis), isRim);
  return hn::And(crosses, foot.isOnFace);
}

/// The middle third of a side of the cube, before it, or beyond it: 1, 0 or 2.
template <class D>
HWY_INLINE hn::Vec<D> thirdOf(D d, hn::Vec<D> other, hn::Vec<D> largest) {
  const auto tripled = hn::Mul(hn::Set(d, 3.0), other);
  const auto upper = hn::IfThenElse(hn::Le(tripled, largest), hn::Set(d, 1.0), hn::Set(d, 2.0));
  return hn::IfThenZeroElse(hn::Lt(tripled, hn::Neg(largest)), upper);
}

/// The limits of the bins that places are in.
template <class D>
HWY_INLINE hn::Vec<D> limitsOf(D d, const NearBins& bins, const LanePlaces<D>& place) {
  using V = hn::Vec<D>;
  const auto row = [&](int k) HWY_ATTR {
    return plainDot(Point<V>{hn::Set(d, bins.toBins[k][0]), hn::Set(d, bins.toBins[k][1]),
                             hn::Set(d, bins.toBins[k][2])},
                    place.away);
  };
  const Point<V> n{row(0), row(1), row(2)};
  const V x = hn::Abs(n.x), y = hn::Abs(n.y), z = hn::Abs(n.z);
  const auto isX = hn::And(hn::Ge(x, y), hn::Ge(x, z)), isY = hn::Ge(y, z);
  const V largest = hn::Max(x, hn::Max(y, z));
  const auto cyclic = [&](V ifX, V ifY, V ifZ) HWY_ATTR {
    return hn::IfThenElse(isX, ifX, hn::IfThenElse(isY, ifY, ifZ));
  };
  const auto add = [&](V& sum, hn::Mask<D> mask, double value) HWY_ATTR {
    sum = hn::Add(sum, hn::IfThenElseZero(mask, hn::Set(d, value)));
  };
  constexpr double kQuarter = NearBins::kKinds, kThird = kQuarter * NearBins::kQuarters;
  V bin = cyclic(hn::Zero(d), hn::Set(d, 18.0 * kThird), hn::Set(d, 36.0 * kThird));
  add(bin, hn::Lt(cyclic(n.x, n.y, n.z), hn::Zero(d)), 9.0 * kThird);
  const V next = thirdOf(d, cyclic(n.y, n.z, n.x), largest);
  const V last = thirdOf(d, cyclic(n.z, n.x, n.y), largest);
  bin = hn::Add(bin, hn::Mul(hn::Set(d, kThird), hn::Add(hn::Mul(hn::Set(d, 3.0), next), last)));
  for (const double bound : NearBins::kQuarterBounds) {
    add(bin, hn::Gt(place.along, hn::Set(d, bound)), kQuarter);
  }
  add(bin, hn::Not(hn::Or(place.isOnFace, place.isFlat)), 1.0);
  // A whole number beside 2^52 is in the last bits.
  const hn::RebindToSigned<D> di;
  const auto index =
      hn::And(hn::BitCast(di, hn::Add(bin, hn::Set(d, 0x1p52))), hn::Set(di, (1LL << 10) - 1));
  static_assert(NearBins::kCount <= 1 << 10);
  return hn::GatherIndex(d, bins.limit, index);
}

/// Those asked places on vertices where a corner goes on straight that stand: across it.
template <class D>
HWY_INLINE hn::Mask<D> standsAtStraight(D d, const PlacedLss& lss, const PlacePairs<D>& pairs,
                                        const LanePlaces<D>& place, hn::Mask<D> asked) {
  using V = hn::Vec<D>;
  for (int vertex = 0; vertex < 3; ++vertex) {
    const auto isStraight = hn::And(asked, place.isStraight[vertex]);
    if (hn::AllFalse(d, isStraight)) continue;
    const int before = (vertex + 2) % 3;
    const auto isBefore = pairs.isFlatEdge[vertex];
    const Point<V> corner = select(isBefore, pairs.edge[before], pairs.edge[vertex]);
    const V along = plainDot(place.away, corner);
    const V squared =
        hn::IfThenElse(isBefore, pairs.squaredEdge[before], pairs.squaredEdge[vertex]);
    const V most = hn::Mul(hn::Set(d, kMore * lss.flatDirection * lss.flatDirection),
                           hn::Mul(squared, place.squared));
    const auto stands = hn::AndNot(hn::And(isBefore, pairs.isFlatEdge[before]),
                                   hn::Le(hn::Mul(along, along), most));
    asked = hn::AndNot(hn::AndNot(stands, isStraight), asked);
  }
  return asked;
}

/// Those of the asked places that may win.
template <class D>
HWY_INLINE hn::Mask<D> mayWin(D d, const PlacedLss& lss, const NearBins& bins,
                              const PlacePairs<D>& pairs, const LanePlaces<D>& place,
                              hn::Mask<D> asked) {
  using V = hn::Vec<D>;
  asked = hn::And(asked, hn::Le(place.squared, hn::Set(d, lss.squaredReach)));
  // Inside a flat surface only an end that is above it along its normal stands.
  const auto isFlat = hn::And(asked, place.isFlat);
  if (!hn::AllFalse(d, isFlat)) {
    const Point<V> across = plainCross(place.away, pairs.normal);
    const V most = hn::Mul(hn::Set(d, kMore * lss.flatDirection * lss.flatDirection),
                           hn::Mul(pairs.squaredNormal, place.squared));
    const auto isAlong = hn::Le(plainDot(across, across), most);
    const auto isAtEnd = hn::Or(isAtFirst(d, place.along), isAtLast(d, place.along));
    asked = hn::AndNot(hn::AndNot(hn::And(isAlong, isAtEnd), isFlat), asked);
  }
  asked = standsAtStraight(d, lss, pairs, place, asked);
  if (hn::AllFalse(d, asked)) return asked;
  return hn::And(asked, hn::Le(place.squared, limitsOf(d, bins, place)));
}

/// Whether the closest points are so near that their difference is noise.
template <class D>
HWY_INLINE hn::Mask<D> isNoisy(D d, const PlacePairs<D>& pairs, hn::Vec<D> squared) {
  const auto sum = [](const Point<hn::Vec<D>>& p) HWY_ATTR {
    return hn::Add(hn::Abs(p.x), hn::Add(hn::Abs(p.y), hn::Abs(p.z)));
  };
  const auto extent = hn::Add(sum(pairs.axis), hn::Add(sum(pairs.vertex[1]), sum(pairs.vertex[2])));
  const auto noise = hn::Mul(hn::Set(d, 1.001 * kNoisyDifference), extent);
  return hn::Le(squared, hn::Mul(noise, noise));
}

/// The places of some lanes, and what of them is offered.
template <class D>
struct PlaceLanes {
  LanePlaces<D> place[kPlaceSources];
  hn::Mask<D> isWhole[kPlaceSources], isOffered[kPlaceSources];
  hn::Mask<D> unsure;
};

/// The nearest is the whole pair's; it is the first of equals.
template <class D>
HWY_INLINE void chooseWhole(D d, const PlacedLss& lss, const PlacePairs<D>& pairs,
                            hn::Mask<D> hasAxis, const hn::Mask<D> (&isInner)[3],
                            PlaceLanes<D>& lanes) {
  using V = hn::Vec<D>;
  V squared = lanes.place[0].squared, along = lanes.place[0].along;
  lanes.isWhole[0] = hn::Eq(along, along);
  for (int i = 1; i < kPlaceSources; ++i) {
    const auto isNearer = hn::And(hasAxis, hn::Lt(lanes.place[i].squared, squared));
    squared = hn::IfThenElse(isNearer, lanes.place[i].squared, squared);
    along = hn::IfThenElse(isNearer, lanes.place[i].along, along);
    lanes.isWhole[i] = isNearer;
    for (int k = 0; k < i; ++k) lanes.isWhole[k] = hn::AndNot(isNearer, lanes.isWhole[k]);
  }
  lanes.unsure = hn::Or(lanes.unsure, hn::Or(hn::Gt(squared, hn::Set(d, lss.squaredReach)),
                                             isNoisy(d, pairs, squared)));
  lanes.isOffered[0] = hn::Or(lanes.isWhole[0], hn::AndNot(isAtFirst(d, along), hasAxis));
  lanes.isOffered[1] = hn::Or(lanes.isWhole[1], hn::AndNot(isAtLast(d, along), hasAxis));
  for (int k = 0; k < 3; ++k) {
    lanes.isOffered[2 + k] =
        hn::Or(lanes.isWhole[2 + k], hn::AndNot(pairs.isFlatEdge[k], hn::And(hasAxis, isInner[k])));
  }
}

template <class D>
HWY_INLINE PlaceLanes<D> placesOf(D d, const PlacedLss& lss, const PlacePairs<D>& pairs) {
  using M = hn::Mask<D>;
  const M hasAxis = hn::Gt(pairs.squaredAxis, hn::Zero(d));
  M isRimA, isRimB, isInner[3];
  PlaceLanes<D> lanes;
  lanes.place[0] = placeOfEnd(d, pairs, pairs.a, 0.0, isRimA);
  lanes.place[1] = placeOfEnd(d, pairs, pairs.b, 1.0, isRimB);
  lanes.unsure = hn::Or(hn::Or(isRimA, isRimB), hn::And(hasAxis, passesThrough(d, pairs)));
  for (int k = 0; k < 3; ++k) {
    M isTrusted;
    auto& place = lanes.place[2 + k];
    place = placeOfEdge(d, lss, pairs, k, isInner[k], isTrusted);
    // So near an end that the two may count as one place.
    const auto margin = hn::Set(d, 3.0 * kAtEnd), rest = hn::Sub(hn::Set(d, 1.0), margin);
    const M isAtMargin =
        hn::And(isInner[k], hn::Or(hn::Lt(place.along, margin), hn::Gt(place.along, rest)));
    lanes.unsure = hn::Or(lanes.unsure, hn::And(hasAxis, hn::Or(hn::Not(isTrusted), isAtMargin)));
  }
  chooseWhole(d, lss, pairs, hasAxis, isInner, lanes);
  return lanes;
}

template <class D>
HWY_INLINE unsigned maskBits(D d, hn::Mask<D> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

void choosePlaces(const PlacedLss& lss, const NearBins& bins, const PlaceBlock& block,
                  PlaceChoice& choice) {
  const hn::CappedTag<double, PlaceBlock::kSize> d;
  for (std::size_t lane = 0; lane < PlaceBlock::kSize; lane += hn::Lanes(d)) {
    const auto pairs = placePairs(d, lss, block, lane);
    const auto lanes = placesOf(d, lss, pairs);
    choice.unsure |= maskBits(d, lanes.unsure) << lane;
    for (int i = 0; i < kPlaceSources; ++i) {
      const auto asked = hn::AndNot(lanes.unsure, lanes.isOffered[i]);
      const auto may = mayWin(d, lss, bins, pairs, lanes.place[i], asked);
      choice.may[i] |= maskBits(d, may) << lane;
      choice.isWhole[i] |= maskBits(d, lanes.isWhole[i]) << lane;
    }
  }
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {

HWY_EXPORT(choosePlaces);

PlaceChoice mayWinBins(const PlacedLss& lss, const NearBins& bins, const PlaceBlock& block) {
  PlaceChoice choice{};
  HWY_DYNAMIC_DISPATCH(choosePlaces)(lss, bins, block, choice);
  return choice;
}

}  // namespace foretouch::internal
#endif
