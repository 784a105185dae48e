// The nearest features of two triangles only propose directions; the planes normal to them prove
// (middleware/lanes/triangle_pairs.md).
#include "middleware/lanes/triangle_pairs.h"

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/triangle_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "middleware/lanes/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Floats = hn::CappedTag<float, kTrianglePairLanes>;
using Lanes = hn::Vec<Floats>;
using LaneMask = hn::Mask<Floats>;

/// Of the plane's arithmetic, relative to the extents: the proof needs 6.02 unit roundoffs. Halving
/// it breaks the proof; doubling it costs 4e-7 of the extents.
constexpr float kPairPlaneRounding = 6.5F * kUnitRoundoffOfFloat;
/// Of n.velocity, relative to the velocity: the proof needs 4.02 unit roundoffs; where both sides
/// move, relative to both velocities, 5.02.
constexpr float kSpeedRounding = 4.5F * kUnitRoundoffOfFloat;
constexpr float kRelativeSpeedRounding = 5.5F * kUnitRoundoffOfFloat;
/// Shrinks a direction whose normalisation errs by at most 4.51 unit roundoffs.
constexpr float kPairUnitShrink = 1.0F - 5.0F * kUnitRoundoffOfFloat;
/// Shrinks a step whose formula errs by at most 6.01 unit roundoffs.
constexpr float kPairStepShrink = 1.0F - 8.0F * kUnitRoundoffOfFloat;
/// Rounds a pad up past its own roundings.
constexpr float kPadInflation = 1.0F + 4.0F * kUnitRoundoffOfFloat;
/// Bound on underflow, even if denormals flush to zero (m; m per t).
constexpr float kPairUnderflow = 0x1p-80F;
/// Uses a direction only if the square of its length is between these: then no square in it has
/// underflowed or overflowed.
constexpr float kLeastSquare = 0x1p-90F, kMostSquare = 0x1p100F;
/// Ignores smaller clearances and accelerations, so that their product stays clear of underflow (m,
/// m per squared t).
constexpr float kLeastClearance = 0x1p-60F, kLeastAcceleration = 0x1p-40F;
/// Answers nothing beyond this, so that no product is infinite.
constexpr float kMost = 0x1p50F;
/// Below this squared sine the lines along two edges have no trusted crossing.
constexpr float kNearParallelSin2 = 0x1p-21F;
/// Stands for the square of an edge without length.
constexpr float kNoLength = 0x1p-120F;

using Vec3 = Point<Lanes>;

HWY_INLINE Lanes square(const Vec3& a) {
  return dot(a, a);
}
HWY_INLINE Lanes largestOf(Lanes a, Lanes b, Lanes c) {
  return hn::Max(a, hn::Max(b, c));
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

/// Relative to the scene's first vertex. The link's side has kPoints points: a triangle or a
/// segment.
template <int kPoints>
struct Triangles {
  Vec3 link[kPoints];
  Vec3 scene[2];  // the other two vertices
};

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

/// The nearest of the link's edges from `start` and the scene's three.
HWY_INLINE void offerEdge(Floats d, const Edge& one, const Vec3& start, const Vec3& second,
                          const Edge (&other)[3], NearestEdges& nearest) {
  const Vec3 fromSecond = sub(start, second);
  for (int j = 0; j < 3; ++j) {
    const Vec3& w = j == 2 ? fromSecond : start;
    offerEdges(d, one, other[j], w, dot(one.along, w), dot(other[j].along, w), nearest);
  }
}

template <int kPoints>
HWY_INLINE NearestEdges nearestEdges(Floats d, const Triangles<kPoints>& pair) {
  const Edge other[3] = {edgeAlong(d, pair.scene[0]), edgeAlong(d, pair.scene[1]),
                         edgeAlong(d, sub(pair.scene[1], pair.scene[0]))};
  const Vec3 zero{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  NearestEdges nearest{hn::Set(d, kMostSquare), zero, zero};
  for (int i = 0; i + 1 < kPoints; ++i) {
    const Vec3 along = sub(pair.link[i + 1], pair.link[0]);
    offerEdge(d, edgeAlong(d, along), pair.link[0], pair.scene[0], other, nearest);
  }
  if (kPoints == 3) {
    const Vec3 along = sub(pair.link[kPoints - 1], pair.link[1]);
    offerEdge(d, edgeAlong(d, along), pair.link[1], pair.scene[0], other, nearest);
  }
  return nearest;
}

/// A plane's direction, from the scene towards the link and no longer than 1, and the gap along it.
struct Plane {
  Vec3 n;
  Lanes gap;
};

/// Takes the plane normal to `direction`, of either sign, if its gap is the widest so far.
template <int kPoints>
HWY_INLINE void tryDirection(Floats d, const Triangles<kPoints>& pair, const Vec3& direction,
                             Plane& best) {
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
  const Lanes scene[2] = {dot(n, pair.scene[0]), dot(n, pair.scene[1])};
  const Lanes zero = hn::Zero(d);
  const Lanes above = hn::Sub(lowest, hn::Max(zero, hn::Max(scene[0], scene[1])));
  const Lanes below = hn::Sub(hn::Min(zero, hn::Min(scene[0], scene[1])), highest);
  const Lanes gap = hn::Max(above, below);
  const LaneMask wider = hn::Gt(gap, best.gap);
  const Vec3 turned{hn::Neg(n.x), hn::Neg(n.y), hn::Neg(n.z)};
  best.n = select(wider, select(hn::Gt(below, above), turned, n), best.n);
  best.gap = hn::IfThenElse(wider, gap, best.gap);
}

template <int kPoints>
HWY_INLINE Plane widestPlane(Floats d, const Triangles<kPoints>& pair) {
  const NearestEdges nearest = nearestEdges(d, pair);
  const Vec3 zero{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  Plane best{zero, hn::Zero(d)};
  tryDirection(d, pair, nearest.difference, best);
  tryDirection(d, pair, nearest.across, best);
  tryDirection(d, pair, cross(pair.scene[0], pair.scene[1]), best);
  if (kPoints == 3) {
    const Vec3 e1 = sub(pair.link[1], pair.link[0]);
    tryDirection(d, pair, cross(e1, sub(pair.link[kPoints - 1], pair.link[0])), best);
  }
  return best;
}

/// As safeStep() of lss/safe_step.h. Precondition: clearance >= kLeastClearance,
/// acceleration >= kLeastAcceleration.
HWY_INLINE Lanes rootOf(Floats d, Lanes clearance, Lanes speed, Lanes acceleration) {
  const Lanes twice = hn::Add(clearance, clearance);
  const Lanes root = hn::Sqrt(hn::MulAdd(speed, speed, hn::Mul(twice, acceleration)));
  // Two forms of the positive root, each a sum of terms of one sign.
  const LaneMask opens = hn::Gt(speed, hn::Zero(d));
  const Lanes sum = hn::Add(root, hn::Abs(speed));
  const Lanes step =
      hn::Div(hn::IfThenElse(opens, sum, twice), hn::IfThenElse(opens, acceleration, sum));
  return hn::Mul(hn::Set(d, kPairStepShrink), step);
}

/// Proven bounds on the errors of a block's vectors, and whether all its values are finite and in
/// range.
struct Slack {
  Lanes position, velocity;
  LaneMask inRange;
};

/// The other side at rest.
struct AtRest {
  static constexpr float kRounding = kSpeedRounding;
  HWY_INLINE Lanes withFastest(Lanes ofLink) const { return ofLink; }
  HWY_INLINE Lanes withSquares(Lanes ofLink) const { return ofLink; }
  HWY_INLINE Lanes relative(const Vec3& /*n*/, Lanes speed) const { return speed; }
  HWY_INLINE Lanes acceleration(Floats /*d*/, Lanes ofLink) const { return ofLink; }
};

/// The other side's vertices, all of which a plane must stay above.
struct InMotion {
  static constexpr float kRounding = kRelativeSpeedRounding;
  Vec3 velocity[3];
  Lanes bound;

  HWY_INLINE InMotion(Floats d, const OtherMotions& others, std::size_t first)
      : velocity{load(d, others.velocity[0], first), load(d, others.velocity[1], first),
                 load(d, others.velocity[2], first)},
        bound(hn::Load(d, others.acceleration + first)) {}
  HWY_INLINE Lanes withFastest(Lanes ofLink) const {
    const Lanes squared = largestOf(square(velocity[0]), square(velocity[1]), square(velocity[2]));
    return hn::Add(ofLink, hn::Sqrt(squared));
  }
  HWY_INLINE Lanes withSquares(Lanes ofLink) const {
    return hn::Add(ofLink, sumOf(square(velocity[0]), square(velocity[1]), square(velocity[2])));
  }
  HWY_INLINE Lanes relative(const Vec3& n, Lanes speed) const {
    return hn::Sub(speed, largestOf(dot(n, velocity[0]), dot(n, velocity[1]), dot(n, velocity[2])));
  }
  /// Negative or NaN if either is.
  HWY_INLINE Lanes acceleration(Floats d, Lanes ofLink) const {
    const LaneMask isBound = hn::And(hn::Ge(ofLink, hn::Zero(d)), hn::Ge(bound, hn::Zero(d)));
    const Lanes sum = hn::Mul(hn::Add(ofLink, bound), hn::Set(d, kPadInflation));
    return hn::IfThenElse(isBound, sum, hn::Set(d, -1.0F));
  }
};

template <int kPoints, class Other>
HWY_INLINE Slack slackOf(Floats d, const TrianglePairBlock& block, std::size_t first,
                         const Triangles<kPoints>& pair, const Vec3 (&velocity)[kPoints],
                         const Other& other) {
  const Lanes scene[2] = {square(pair.scene[0]), square(pair.scene[1])};
  // Sums, because a maximum might hide a NaN.
  Lanes squares = other.withSquares(hn::Add(scene[0], scene[1]));
  Lanes farthest = hn::Zero(d), fastestSquare = farthest;
  for (int i = 0; i < kPoints; ++i) {
    const Lanes place = square(pair.link[i]), speed = square(velocity[i]);
    squares = sumOf(place, speed, squares);
    farthest = hn::Max(farthest, place);
    fastestSquare = hn::Max(fastestSquare, speed);
  }
  const Lanes inflation = hn::Set(d, kPadInflation), underflow = hn::Set(d, kPairUnderflow);
  const Lanes positionPad = hn::Load(d, block.positionPad + first);
  const Lanes velocityPad = hn::Load(d, block.velocityPad + first);
  const Lanes extent = hn::Add(hn::Sqrt(farthest), hn::Sqrt(hn::Max(scene[0], scene[1])));
  const Lanes fastest = other.withFastest(hn::Sqrt(fastestSquare));
  const Lanes pads = hn::Add(positionPad, velocityPad);
  const LaneMask padsInRange = hn::And(hn::Ge(hn::Min(positionPad, velocityPad), hn::Zero(d)),
                                       hn::Le(pads, hn::Set(d, kMost)));
  Slack slack;
  slack.position = hn::MulAdd(hn::Set(d, kPairPlaneRounding), extent,
                              hn::MulAdd(positionPad, inflation, underflow));
  slack.velocity = hn::MulAdd(hn::Set(d, Other::kRounding), fastest,
                              hn::MulAdd(velocityPad, inflation, underflow));
  slack.inRange = hn::And(padsInRange, hn::Le(squares, hn::Set(d, kMost * kMost)));
  return slack;
}

/// The plane's proof: the gap of each of the link's vertices, how fast it grows, and so for how
/// long all stay above `floor`.
template <int kPoints, class Other>
HWY_INLINE void answer(Floats d, const TrianglePairBlock& block, const Other& other,
                       std::size_t first, TrianglePairSteps& steps) {
  const Vec3 origin = load(d, block.scene[0], first);
  Triangles<kPoints> pair;
  Vec3 velocity[kPoints];
  for (int i = 0; i < kPoints; ++i) {
    pair.link[i] = sub(load(d, block.link[i], first), origin);
    velocity[i] = load(d, block.velocity[i], first);
  }
  for (int i = 0; i < 2; ++i) pair.scene[i] = sub(load(d, block.scene[i + 1], first), origin);
  const Slack slack = slackOf(d, block, first, pair, velocity, other);
  const Plane plane = widestPlane(d, pair);

  const Lanes top =
      largestOf(hn::Zero(d), dot(plane.n, pair.scene[0]), dot(plane.n, pair.scene[1]));
  const Lanes floor = hn::Load(d, block.floor + first);
  const Lanes most = hn::Set(d, kMost);
  LaneMask clears = hn::And(slack.inRange, hn::Ge(floor, hn::Zero(d)));
  Lanes lower = most, step = most;
  for (int i = 0; i < kPoints; ++i) {
    const Lanes given = other.acceleration(d, hn::Load(d, block.acceleration[i] + first));
    const Lanes gap = hn::Sub(hn::Sub(dot(plane.n, pair.link[i]), top), slack.position);
    const Lanes clearance = hn::Sub(gap, floor);
    const Lanes speed = hn::Sub(other.relative(plane.n, dot(plane.n, velocity[i])), slack.velocity);
    lower = hn::Min(lower, gap);
    step =
        hn::Min(step, rootOf(d, clearance, speed, hn::Max(given, hn::Set(d, kLeastAcceleration))));
    const LaneMask bounded = hn::And(hn::Ge(given, hn::Zero(d)), hn::Le(given, most));
    clears = hn::And(clears, hn::And(bounded, hn::Ge(clearance, hn::Set(d, kLeastClearance))));
  }
  lower = hn::Max(lower, hn::Zero(d));
  hn::Store(hn::IfThenElseZero(slack.inRange, lower), d, steps.lower + first);
  hn::Store(hn::IfThenElseZero(clears, step), d, steps.step + first);
}

void proveLanes(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += lanes)
    answer<3>(d, block, AtRest(), first, steps);
}

void proveMovingLanes(const TrianglePairBlock& block, const OtherMotions& others, std::size_t count,
                      TrianglePairSteps& steps) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += lanes) {
    answer<3>(d, block, InMotion(d, others, first), first, steps);
  }
}

void proveSegmentLanes(const TrianglePairBlock& block, std::size_t count,
                       TrianglePairSteps& steps) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += lanes)
    answer<2>(d, block, AtRest(), first, steps);
}

}  // namespace
}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {

HWY_EXPORT(proveLanes);
HWY_EXPORT(proveMovingLanes);
HWY_EXPORT(proveSegmentLanes);

}  // namespace

void proveSteps(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps) {
  HWY_DYNAMIC_DISPATCH(proveLanes)(block, count, steps);
}

void proveSteps(const TrianglePairBlock& block, const OtherMotions& others, std::size_t count,
                TrianglePairSteps& steps) {
  HWY_DYNAMIC_DISPATCH(proveMovingLanes)(block, others, count, steps);
}

void proveSegmentSteps(const TrianglePairBlock& block, std::size_t count,
                       TrianglePairSteps& steps) {
  HWY_DYNAMIC_DISPATCH(proveSegmentLanes)(block, count, steps);
}

}  // namespace foretouch::internal
#endif
