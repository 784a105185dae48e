#include "middleware/lanes/axis_parts.h"

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/axis_parts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "middleware/lanes/triangle_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace {

/// Rounds the sum of two radii, a part's pad, or the root of a square up; and the first down.
constexpr float kSumOfRadii = 1.0F + 4.0F * kUnitRoundoffOfFloat;
constexpr float kLeastSumOfRadii = 1.0F - 4.0F * kUnitRoundoffOfFloat;
/// Outweighs the rounding of the last difference.
constexpr float kGapRounding = 2.0F * kUnitRoundoffOfFloat;

HWY_INLINE Vec3 all(Floats d, const float (&p)[3]) {
  return {hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])};
}

struct Distances {
  Lanes lower, upper;
};

template <int kPoints>
HWY_INLINE Distances distancesFrom(Floats d, const StillAxis& axis, const PartRows& parts,
                                   std::size_t first) {
  const Vec3 origin = load(d, parts.point[0], first);
  Triangles<2, kPoints> pair;
  for (int i = 0; i < 2; ++i) pair.link[i] = sub(all(d, axis.point[i]), origin);
  // Sums, because a maximum might hide a NaN.
  Lanes squares = hn::Zero(d), farthest = squares;
  for (int i = 1; i < kPoints; ++i) {
    pair.scene[i - 1] = sub(load(d, parts.point[i], first), origin);
    const Lanes own = square(pair.scene[i - 1]);
    squares = hn::Add(squares, own);
    farthest = hn::Max(farthest, own);
  }
  const Lanes ends[2] = {square(pair.link[0]), square(pair.link[1])};
  const Lanes rho = hn::Load(d, parts.rho + first);
  const Lanes pad = hn::Mul(hn::MulAdd(hn::Set(d, axis.padPerRho), rho, hn::Set(d, axis.pad)),
                            hn::Set(d, kSumOfRadii));
  const Lanes extent = hn::Add(hn::Sqrt(farthest), hn::Sqrt(hn::Max(ends[0], ends[1])));
  const Lanes slack =
      hn::MulAdd(hn::Set(d, kPairPlaneRounding), extent,
                 hn::MulAdd(pad, hn::Set(d, kPadInflation), hn::Set(d, kPairUnderflow)));
  const LaneMask inRange =
      hn::And(hn::And(hn::Ge(pad, hn::Zero(d)), hn::Le(pad, hn::Set(d, kMost))),
              hn::Le(sumOf(squares, ends[0], ends[1]), hn::Set(d, kMost * kMost)));
  const NearestEdges nearest = nearestEdges(d, pair);
  const Plane plane = widestPlane(d, pair, nearest);
  const Lanes lowest = hn::Min(dot(plane.n, pair.link[0]), dot(plane.n, pair.link[1]));
  const Lanes gap = hn::Sub(hn::Sub(lowest, topOf(d, pair, plane.n)), slack);
  const Lanes apart = hn::MulAdd(hn::Sqrt(nearest.squaredDistance), hn::Set(d, kSumOfRadii), slack);
  return {hn::IfThenElseZero(inRange, hn::Max(gap, hn::Zero(d))),
          hn::IfThenElse(inRange, apart, hn::Set(d, kMost))};
}

void boundGapsInLanes(const StillAxis& axis, const PartRows& parts, GapBounds& gaps) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  const Lanes rounding = hn::Set(d, kGapRounding);
  for (std::size_t first = 0; first < static_cast<std::size_t>(parts.count); first += lanes) {
    const Distances distances = parts.areAxes ? distancesFrom<2>(d, axis, parts, first)
                                              : distancesFrom<3>(d, axis, parts, first);
    const Lanes radii = hn::Add(hn::Set(d, axis.radius), hn::Load(d, parts.radius + first));
    const Lanes lower = hn::Sub(distances.lower, hn::Mul(radii, hn::Set(d, kSumOfRadii)));
    const Lanes upper = hn::Sub(distances.upper, hn::Mul(radii, hn::Set(d, kLeastSumOfRadii)));
    hn::Store(hn::NegMulAdd(rounding, hn::Abs(lower), lower), d, gaps.lower + first);
    hn::Store(hn::MulAdd(rounding, hn::Abs(upper), upper), d, gaps.upper + first);
  }
}

}  // namespace
}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {

HWY_EXPORT(boundGapsInLanes);

}  // namespace

void boundGaps(const StillAxis& axis, const PartRows& parts, GapBounds& gaps) {
  HWY_DYNAMIC_DISPATCH(boundGapsInLanes)(axis, parts, gaps);
}

}  // namespace foretouch::internal
#endif
