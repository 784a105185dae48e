// The nearest features of two triangles only propose directions; the planes normal to them prove
// (middleware/lanes/triangle_pairs.md).
#include "middleware/lanes/triangle_pairs.h"

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/triangle_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "middleware/lanes/triangle_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace {

/// For n.velocity, relative to the velocity: the proof needs 4.02 unit roundoffs; where both sides
/// move, relative to both velocities, 5.02.
constexpr float kSpeedRounding = 4.5F * kUnitRoundoffOfFloat;
constexpr float kRelativeSpeedRounding = 5.5F * kUnitRoundoffOfFloat;
/// Shrinks a step whose formula errs by at most 6.01 unit roundoffs.
constexpr float kPairStepShrink = 1.0F - 8.0F * kUnitRoundoffOfFloat;
/// Ignores smaller clearances and accelerations, so that their product stays clear of underflow (m,
/// m per squared t).
constexpr float kLeastClearance = 0x1p-60F, kLeastAcceleration = 0x1p-40F;

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
template <int kScenePoints>
struct InMotion {
  static constexpr float kRounding = kRelativeSpeedRounding;
  Vec3 velocity[kScenePoints];
  Lanes bound;

  HWY_INLINE InMotion(Floats d, const OtherMotions& others, std::size_t first)
      : bound(hn::Load(d, others.acceleration + first)) {
    for (int i = 0; i < kScenePoints; ++i) velocity[i] = load(d, others.velocity[i], first);
  }
  HWY_INLINE Lanes withFastest(Lanes ofLink) const {
    Lanes squared = square(velocity[0]);
    for (int i = 1; i < kScenePoints; ++i) squared = hn::Max(squared, square(velocity[i]));
    return hn::Add(ofLink, hn::Sqrt(squared));
  }
  HWY_INLINE Lanes withSquares(Lanes ofLink) const {
    for (const Vec3& v : velocity) ofLink = hn::Add(ofLink, square(v));
    return ofLink;
  }
  HWY_INLINE Lanes relative(const Vec3& n, Lanes speed) const {
    Lanes ahead = dot(n, velocity[0]);
    for (int i = 1; i < kScenePoints; ++i) ahead = hn::Max(ahead, dot(n, velocity[i]));
    return hn::Sub(speed, ahead);
  }
  /// Negative or NaN if either is.
  HWY_INLINE Lanes acceleration(Floats d, Lanes ofLink) const {
    const LaneMask isBound = hn::And(hn::Ge(ofLink, hn::Zero(d)), hn::Ge(bound, hn::Zero(d)));
    const Lanes sum = hn::Mul(hn::Add(ofLink, bound), hn::Set(d, kPadInflation));
    return hn::IfThenElse(isBound, sum, hn::Set(d, -1.0F));
  }
};

template <int kPoints, int kScenePoints, class Other>
HWY_INLINE Slack slackOf(Floats d, const TrianglePairBlock& block, std::size_t first,
                         const Triangles<kPoints, kScenePoints>& pair,
                         const Vec3 (&velocity)[kPoints], const Other& other) {
  // Sums, because a maximum might hide a NaN.
  Lanes scene = square(pair.scene[0]), squares = scene;
  if (kScenePoints == 3) {
    const Lanes last = square(pair.scene[kScenePoints - 2]);
    scene = hn::Max(scene, last);
    squares = hn::Add(squares, last);
  }
  squares = other.withSquares(squares);
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
  const Lanes extent = hn::Add(hn::Sqrt(farthest), hn::Sqrt(scene));
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
template <int kPoints, int kScenePoints, class Other>
HWY_INLINE void answer(Floats d, const TrianglePairBlock& block, const Other& other,
                       std::size_t first, TrianglePairSteps& steps) {
  const Vec3 origin = load(d, block.scene[0], first);
  Triangles<kPoints, kScenePoints> pair;
  Vec3 velocity[kPoints];
  for (int i = 0; i < kPoints; ++i) {
    pair.link[i] = sub(load(d, block.link[i], first), origin);
    velocity[i] = load(d, block.velocity[i], first);
  }
  for (int i = 1; i < kScenePoints; ++i) {
    pair.scene[i - 1] = sub(load(d, block.scene[i], first), origin);
  }
  const Slack slack = slackOf(d, block, first, pair, velocity, other);
  const Plane plane = widestPlane(d, pair, nearestEdges(d, pair));

  const Lanes top = topOf(d, pair, plane.n);
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

template <int kPoints, int kScenePoints>
HWY_INLINE void proveAtRest(const TrianglePairBlock& block, std::size_t count,
                            TrianglePairSteps& steps) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += lanes) {
    answer<kPoints, kScenePoints>(d, block, AtRest(), first, steps);
  }
}

template <int kPoints, int kScenePoints>
HWY_INLINE void proveInMotion(const TrianglePairBlock& block, const OtherMotions& others,
                              std::size_t count, TrianglePairSteps& steps) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += lanes) {
    const InMotion<kScenePoints> motion(d, others, first);
    answer<kPoints, kScenePoints>(d, block, motion, first, steps);
  }
}

void proveLanes(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps) {
  proveAtRest<3, 3>(block, count, steps);
}

void proveSegmentLanes(const TrianglePairBlock& block, std::size_t count,
                       TrianglePairSteps& steps) {
  proveAtRest<2, 3>(block, count, steps);
}

void proveMovingLanes(const TrianglePairBlock& block, const OtherMotions& others, std::size_t count,
                      TrianglePairSteps& steps) {
  proveInMotion<3, 3>(block, others, count, steps);
}

void proveMovingSegmentLanes(const TrianglePairBlock& block, const OtherMotions& others,
                             std::size_t count, TrianglePairSteps& steps) {
  proveInMotion<2, 3>(block, others, count, steps);
}

void proveMovingAxisLanes(const TrianglePairBlock& block, const OtherMotions& others,
                          std::size_t count, TrianglePairSteps& steps) {
  proveInMotion<2, 2>(block, others, count, steps);
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
HWY_EXPORT(proveMovingSegmentLanes);
HWY_EXPORT(proveMovingAxisLanes);

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

void proveSegmentSteps(const TrianglePairBlock& block, const OtherMotions& others,
                       std::size_t count, TrianglePairSteps& steps) {
  HWY_DYNAMIC_DISPATCH(proveMovingSegmentLanes)(block, others, count, steps);
}

void proveAxisSteps(const TrianglePairBlock& block, const OtherMotions& others, std::size_t count,
                    TrianglePairSteps& steps) {
  HWY_DYNAMIC_DISPATCH(proveMovingAxisLanes)(block, others, count, steps);
}

}  // namespace foretouch::internal
#endif
