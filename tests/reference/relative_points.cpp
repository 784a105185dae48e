#include "tests/reference/relative_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/reference/relative_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lss/double_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = HWY_CAPPED(double, kNodes);
using Vector = hn::Vec<Lanes>;

void relativePointInLanes(const LinkNodes& carrier, const LinkNodes& link, const double* p_L,
                          RelativePoint& point) {
  const Lanes d;
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    Vector w[3];
    for (int axis = 0; axis < 3; ++axis) {
      w[axis] = hn::Sub(hn::Load(d, link.p[axis] + lane), hn::Load(d, carrier.p[axis] + lane));
      for (int i = 0; i < 3; ++i) {
        w[axis] = hn::MulAdd(hn::Load(d, link.R[3 * axis + i] + lane), hn::Set(d, p_L[i]), w[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      Vector sum = hn::Mul(hn::Load(d, carrier.R[axis] + lane), w[0]);
      sum = hn::MulAdd(hn::Load(d, carrier.R[3 + axis] + lane), w[1], sum);
      sum = hn::MulAdd(hn::Load(d, carrier.R[6 + axis] + lane), w[2], sum);
      hn::Store(sum, d, point.y[axis] + lane);
    }
  }
}

HWY_INLINE Vector squareOf(Vector x, Vector y, Vector z) {
  return hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x)));
}

LargestSquares largestSquaresInLanes(const RelativePoint& point, const AxisSegment& axis) {
  const Lanes d;
  const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0);
  Vector fromAxis = zero, fromOrigin = zero;
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    Vector y[3], w[3];
    Vector along = zero;
    for (int i = 0; i < 3; ++i) {
      y[i] = hn::Load(d, point.y[i] + lane);
      w[i] = hn::Sub(y[i], hn::Set(d, axis.a[i]));
      along = hn::MulAdd(w[i], hn::Set(d, axis.u[i]), along);
    }
    const Vector s = hn::Min(hn::Max(hn::Mul(along, hn::Set(d, axis.inverse)), zero), one);
    for (int i = 0; i < 3; ++i) w[i] = hn::NegMulAdd(s, hn::Set(d, axis.u[i]), w[i]);
    fromAxis = hn::Max(fromAxis, squareOf(w[0], w[1], w[2]));
    fromOrigin = hn::Max(fromOrigin, squareOf(y[0], y[1], y[2]));
  }
  return {hn::GetLane(hn::MaxOfLanes(d, fromAxis)), hn::GetLane(hn::MaxOfLanes(d, fromOrigin))};
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {
HWY_EXPORT(relativePointInLanes);
HWY_EXPORT(largestSquaresInLanes);
}  // namespace

void relativePoint(const LinkNodes& carrier, const LinkNodes& link, const double* p_L,
                   RelativePoint& point) {
  HWY_DYNAMIC_DISPATCH(relativePointInLanes)(carrier, link, p_L, point);
}

LargestSquares largestSquares(const RelativePoint& point, const AxisSegment& axis) {
  return HWY_DYNAMIC_DISPATCH(largestSquaresInLanes)(point, axis);
}

}  // namespace foretouch::internal
#endif
