#include "tessellation/axis_curve.h"

#include <algorithm>

#include "lss/rounding.h"
#include "tessellation/point_rounding.h"
#include "tessellation/polynomial_matrices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessellation/axis_curve.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tessellation/curve_lanes-inl.h"

#ifndef FORETOUCH_TESSELLATION_FITTED_END
#define FORETOUCH_TESSELLATION_FITTED_END
namespace foretouch::internal {
/// One end's polynomials and their bounds, as computed.
struct FittedEnd {
  alignas(64) double rows[3][kNodes];  ///< [axis][power of x]
  double weighted;                     ///< Sum of (2j+2)|c_j| over the coefficients' vectors.
  double acceleration;                 ///< Largest |control point| of the second derivative by x.
};
}  // namespace foretouch::internal
#endif

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

using internal::FittedEnd;
using internal::PolynomialMatrices;

/// The end's places in the frame at the nodes.
HWY_INLINE void placeEnd(const LinkNodes& link, const double* p_L, const LinkNodes* frame,
                         double (*samples)[kNodes]) {
  const NodeLanes d;
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    NodeVector p[3];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = pointAt(d, link, p_L, 0.0, axis, lane);
      if (frame != nullptr) p[axis] = hn::Sub(p[axis], hn::Load(d, frame->p[axis] + lane));
    }
    for (int axis = 0; axis < 3; ++axis) {
      NodeVector sum = p[axis];
      if (frame != nullptr) {
        sum = hn::Mul(hn::Load(d, frame->R[axis] + lane), p[0]);
        sum = hn::MulAdd(hn::Load(d, frame->R[3 + axis] + lane), p[1], sum);
        sum = hn::MulAdd(hn::Load(d, frame->R[6 + axis] + lane), p[2], sum);
      }
      hn::Store(sum, d, samples[axis] + lane);
    }
  }
}

void fitEnd(const PolynomialMatrices& matrices, const LinkNodes& link, const double* p_L,
            const LinkNodes* frame, FittedEnd& end) {
  const NodeLanes d;
  alignas(64) double samples[3][kNodes];
  placeEnd(link, p_L, frame, samples);
  NodeVector weighted = hn::Zero(d);
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    NodeVector square = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const NodeVector c = combined(d, samples[axis], matrices.coefficients, 0, lane);
      hn::Store(c, d, end.rows[axis] + lane);
      square = hn::MulAdd(c, c, square);
    }
    weighted = hn::MulAdd(hn::Sqrt(square), hn::Load(d, matrices.evaluation + lane), weighted);
  }
  end.weighted = hn::GetLane(hn::SumOfLanes(d, weighted));
  end.acceleration = largestNorm(end.rows, 3, matrices.second, 2);
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(fitEnd);

using internal::FittedEnd;
using internal::kInflation;

// Roundings, derived in lss_polynomials.md 5; checked by tests/tessellation/axis_curve_test.cpp.
constexpr double kFrameSum = 4.0;     ///< The frame's origin's, in u of both reaches.
constexpr double kFrameTurn = 16.0;   ///< The turn's into the frame, in u of the arm.
constexpr double kHorner = 16.0;      ///< A place's, in u of weighted.
constexpr double kHornerRate = 64.0;  ///< A derivative's by x, in u of weighted.

double errorOf(const FittedEnd& end, const MotionBounds& bounds, double rho,
               const ChainNodes& nodes) {
  const NodeBounds& at = nodes.bounds();
  const double sample = internal::pointRounding(at, rho) + at.positionRounding +
                        kFrameSum * kUnitRoundoff * (at.reach + rho) +
                        (at.rotationRounding + kFrameTurn * kUnitRoundoff) * end.weighted +
                        bounds.speedAt(rho) * internal::kInstantRounding;
  return (interpolationError(bounds, rho, nodes.end() - nodes.begin()) +
          internal::kLebesgue * sample +
          (internal::kFitting + kHorner) * kUnitRoundoff * end.weighted) *
         kInflation;
}

}  // namespace

AxisCurve axisCurve(const LssTable::Entry& entry, const MotionBounds& bounds,
                    const ChainNodes& nodes, const LinkNodes* frame) {
  FittedEnd a, b;
  const internal::PolynomialMatrices& matrices = internal::polynomialMatrices();
  const LinkNodes& link = nodes.link(entry.link);
  HWY_DYNAMIC_DISPATCH(fitEnd)(matrices, link, entry.a, frame, a);
  HWY_DYNAMIC_DISPATCH(fitEnd)(matrices, link, entry.b, frame, b);
  AxisCurve curve;
  for (int j = 0; j < kNodes; ++j) {
    for (int axis = 0; axis < 3; ++axis) {
      curve.coefficients[j][axis] = a.rows[axis][j];
      curve.coefficients[j][3 + axis] = b.rows[axis][j];
    }
    curve.coefficients[j][6] = curve.coefficients[j][7] = 0.0;
  }
  curve.begin = nodes.begin();
  curve.toX = 2.0 / (nodes.end() - nodes.begin());
  curve.error =
      std::max(errorOf(a, bounds, entry.rhoA, nodes), errorOf(b, bounds, entry.rhoB, nodes));
  const double weighted = std::max(a.weighted, b.weighted), square = curve.toX * curve.toX;
  curve.velocityRounding = kHornerRate * kUnitRoundoff * weighted * curve.toX * kInflation;
  curve.accelerationA =
      (a.acceleration + internal::kControlRounding * a.weighted) * square * kInflation;
  curve.accelerationB =
      (b.acceleration + internal::kControlRounding * b.weighted) * square * kInflation;
  return curve;
}

AxisCurve::Ends AxisCurve::endsAt(double t) const {
  const double x = (t - begin) * toX - 1.0;
  double place[kRows], rate[kRows];
  for (int i = 0; i < kRows; ++i) {
    place[i] = coefficients[kNodes - 1][i];
    rate[i] = 0.0;
  }
  for (int j = kNodes - 2; j >= 0; --j) {
    for (int i = 0; i < kRows; ++i) {
      rate[i] = rate[i] * x + place[i];
      place[i] = place[i] * x + coefficients[j][i];
    }
  }
  const Eigen::Vector3d a(place), b(place + 3), rateA(rate), rateB(rate + 3);
  return {a, b, toX * rateA, toX * rateB};
}

}  // namespace foretouch
#endif
