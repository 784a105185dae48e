// middleware/lanes/triangle_planes-inl.h: the widest plane between two triangles, or segments, of
// every lane, for the kernels that prove by it; compiled once per vector width. The nearest
// features only propose directions (middleware/lanes/triangle_pairs.md). Nothing in here may be
// shared with other sources (lss_pairs-inl.h).
#if defined(FORETOUCH_LANES_TRIANGLE_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FORETOUCH_LANES_TRIANGLE_PLANES_INL_H
#undef FORETOUCH_LANES_TRIANGLE_PLANES_INL_H
#else
#define FORETOUCH_LANES_TRIANGLE_PLANES_INL_H
#endif

#include <hwy/highway.h>

#include "lss/rounding.h"
#include "middleware/lanes/pair_floats.h"
#include "middleware/lanes/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Floats = hn::CappedTag<float, kTrianglePairLanes>;
using Lanes = hn::Vec<Floats>;
using LaneMask = hn::Mask<Floats>;
using Vec3 = Point<Lanes>;

/// The rounding of the plane's arithmetic, relative to the extents: the proof needs 6.02 unit
/// roundoffs. Halving it breaks the proof; doubling it costs 4e-7 of the extents.
constexpr float kPairPlaneRounding = 6.5F * kUnitRoundoffOfFloat;
/// Shrinks a direction whose normalisation errs by at most 4.51 unit roundoffs.
constexpr float kPairUnitShrink = 1.0F - 5.0F * kUnitRoundoffOfFloat;
/// Rounds a pad up past its own roundings.
constexpr float kPadInflation = 1.0F + 4.0F * kUnitRoundoffOfFloat;
/// Bound on underflow, even if denormals flush to zero (m; m per t).
constexpr float kPairUnderflow = 0x1p-80F;
/// Uses a direction only if the square of its length is between these: then no square in it has
/// underflowed or overflowed.
constexpr float kLeastSquare = 0x1p-90F, kMostSquare = 0x1p100F;
/// Answers nothing beyond this, so that no product is infinite.
constexpr float kMost = 0x1p50F;
/// Below this squared sine the lines along two edges have no trusted crossing.
constexpr float kNearParallelSin2 = 0x1p-21F;
/// Stands for the square of an edge without length.
constexpr float kNoLength = 0x1p-120F;

HWY_INLINE Lanes square(const Vec3& a) {
  return dot(a, a);
}
HWY_INLINE Lanes sumOf(Lanes a, Lanes b, Lanes c) {
  return hn::Add(a, hn::Add(b, c));
}
HWY_INLINE LaneMask isInside(Floats d, Lanes s) {
  return hn::And(hn::Gt(s, hn::Zero(d)), hn::Lt(s, hn::Set(d, 1.0F)));
}

HWY_INLINE Vec3 load(Floats d, const PairFloats (&axes)[3], std::size_t first) {
  return {hn::Load(d, axes[0] + first), hn::Load(d, axes[1] + first), hn::Load(d, axes[2] + first)};
}

/// Relative to the scene's first vertex. Each side has two points or three: a segment or a
/// triangle.
template <int kPoints, int kScenePoints>
struct Triangles {
  Vec3 link[kPoints];
  Vec3 scene[kScenePoints - 1];  // the other vertices
};

/// The top of the heights of all of the scene's vertices, the first of which is 0.
template <int kPoints, int kScenePoints>
HWY_INLINE Lanes topOf(Floats d, const Triangles<kPoints, kScenePoints>& pair, const Vec3& n) {
  Lanes top = hn::Zero(d);
  for (const Vec3& point : pair.scene) top = hn::Max(top, dot(n, point));
  return top;
}

/// An edge from one of the vertices.
struct Edge {
  Vec3 along;
  Lanes square, inverseSquare;
};

HWY_INLINE Edge edgeAlong(Floats d, const Vec3& along) {
  const Lanes squared = square(along);
  return {along, squared, hn::Div(hn::Set(d, 1.0F), hn::Max(squared, hn::Set(d, kNoLength)))};
}

/// The nearest two edges so far: the difference of their closest points, and the normals of the
/// features that face each other.
struct NearestEdges {
  Lanes squaredDistance;
  Vec3 difference;  // from the scene towards the link
  Vec3 across;      // of both edges; where both closest points are inside theirs
};

/// The edges w + s*one and t*other, s and t in [0,1]: after [Ericson05] 5.1.9.
HWY_INLINE void offerEdges(Floats d, const Edge& one, const Edge& other, const Vec3& w,
                           Lanes oneByW, Lanes otherByW, NearestEdges& nearest) {
  const Lanes mixed = dot(one.along, other.along);
  const Lanes scale = hn::Mul(one.square, other.square);
  const Lanes determinant = hn::NegMulAdd(mixed, mixed, scale);
  const LaneMask crosses = hn::Gt(determinant, hn::Mul(hn::Set(d, kNearParallelSin2), scale));
  const Lanes numerator = hn::NegMulAdd(other.square, oneByW, hn::Mul(mixed, otherByW));
  const Lanes crossing = hn::IfThenElseZero(crosses, hn::Div(numerator, determinant));
  const Lanes t =
      clamp01(hn::Mul(hn::MulAdd(clamp01(crossing), mixed, otherByW), other.inverseSquare));
  const Lanes s = clamp01(hn::Mul(hn::MulSub(t, mixed, oneByW), one.inverseSquare));

  const Vec3 difference = against(along(w, s, one.along), t, other.along);
  const Lanes squaredDistance = square(difference);
  const LaneMask nearer = hn::Lt(squaredDistance, nearest.squaredDistance);
  // If a point is inside its edge, the difference is normal to that edge up to rounding, which
  // would tilt the plane by the length of the edge.
  const LaneMask insideOne = isInside(d, s), insideOther = isInside(d, t);
  const Lanes tiltOther =
      hn::IfThenElseZero(insideOther, hn::Mul(dot(difference, other.along), other.inverseSquare));
  const Lanes tiltOne =
      hn::IfThenElseZero(insideOne, hn::Mul(dot(difference, one.along), one.inverseSquare));
  const Vec3 straight = against(against(difference, tiltOther, other.along), tiltOne, one.along);
  nearest.squaredDistance = hn::IfThenElse(nearer, squaredDistance, nearest.squaredDistance);
  nearest.difference = select(nearer, straight, nearest.difference);
  nearest.across = select(nearer, cross(one.along, other.along), nearest.across);
}

/// The nearest of the link's edge from `start` and the scene's: one of a segment, three of a
/// triangle.
template <int kScenePoints>
HWY_INLINE void offerEdge(Floats d, const Edge& one, const Vec3& start, const Vec3& second,
                          const Edge (&other)[3], NearestEdges& nearest) {
  const Vec3 fromSecond = sub(start, second);
  for (int j = 0; j < (kScenePoints == 3 ? 3 : 1); ++j) {
    const Vec3& w = j == 2 ? fromSecond : start;
    offerEdges(d, one, other[j], w, dot(one.along, w), dot(other[j].along, w), nearest);
  }
}

template <int kPoints, int kScenePoints>
HWY_INLINE NearestEdges nearestEdges(Floats d, const Triangles<kPoints, kScenePoints>& pair) {
  const Vec3& last = pair.scene[kScenePoints - 2];
  Edge other[3] = {edgeAlong(d, pair.scene[0])};
  if (kScenePoints == 3) {
    other[1] = edgeAlong(d, last);
    other[2] = edgeAlong(d, sub(last, pair.scene[0]));
  }
  const Vec3 zero{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  NearestEdges nearest{hn::Set(d, kMostSquare), zero, zero};
  for (int i = 0; i + 1 < kPoints; ++i) {
    const Vec3 along = sub(pair.link[i + 1], pair.link[0]);
    offerEdge<kScenePoints>(d, edgeAlong(d, along), pair.link[0], pair.scene[0], other, nearest);
  }
  if (kPoints == 3) {
    const Vec3 along = sub(pair.link[kPoints - 1], pair.link[1]);
    offerEdge<kScenePoints>(d, edgeAlong(d, along), pair.link[1], pair.scene[0], other, nearest);
  }
  return nearest;
}

/// A plane's direction, from the scene towards the link and no longer than 1, and the gap along it.
struct Plane {
  Vec3 n;
  Lanes gap;
};

/// Takes the plane normal to `direction`, of either sign, if its gap is the widest so far.
template <int kPoints, int kScenePoints>
HWY_INLINE void tryDirection(Floats d, const Triangles<kPoints, kScenePoints>& pair,
                             const Vec3& direction, Plane& best) {
  const Lanes squared = square(direction);
  const LaneMask usable =
      hn::And(hn::Gt(squared, hn::Set(d, kLeastSquare)), hn::Lt(squared, hn::Set(d, kMostSquare)));
  const Lanes shrink =
      hn::IfThenElseZero(usable, hn::Div(hn::Set(d, kPairUnitShrink), hn::Sqrt(squared)));
  const Vec3 n = scaled(shrink, direction);
  Lanes lowest = dot(n, pair.link[0]), highest = lowest;
  for (int i = 1; i < kPoints; ++i) {
    const Lanes height = dot(n, pair.link[i]);
    lowest = hn::Min(lowest, height);
    highest = hn::Max(highest, height);
  }
  Lanes top = hn::Zero(d), bottom = top;
  for (const Vec3& point : pair.scene) {
    const Lanes height = dot(n, point);
    top = hn::Max(top, height);
    bottom = hn::Min(bottom, height);
  }
  const Lanes above = hn::Sub(lowest, top), below = hn::Sub(bottom, highest);
  const Lanes gap = hn::Max(above, below);
  const LaneMask wider = hn::Gt(gap, best.gap);
  const Vec3 turned{hn::Neg(n.x), hn::Neg(n.y), hn::Neg(n.z)};
  best.n = select(wider, select(hn::Gt(below, above), turned, n), best.n);
  best.gap = hn::IfThenElse(wider, gap, best.gap);
}

template <int kPoints, int kScenePoints>
HWY_INLINE Plane widestPlane(Floats d, const Triangles<kPoints, kScenePoints>& pair,
                             const NearestEdges& nearest) {
  const Vec3 zero{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  Plane best{zero, hn::Zero(d)};
  tryDirection(d, pair, nearest.difference, best);
  tryDirection(d, pair, nearest.across, best);
  if (kScenePoints == 3) {
    tryDirection(d, pair, cross(pair.scene[0], pair.scene[kScenePoints - 2]), best);
  }
  if (kPoints == 3) {
    const Vec3 e1 = sub(pair.link[1], pair.link[0]);
    tryDirection(d, pair, cross(e1, sub(pair.link[kPoints - 1], pair.link[0])), best);
  }
  return best;
}

}  // namespace
}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
