#include "tessellation/lss_polynomials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lss/rounding.h"
#include "lss/single.h"
#include "tessellation/point_rounding.h"
#include "tessellation/polynomial_matrices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessellation/lss_polynomials.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tessellation/curve_lanes-inl.h"

#ifndef FORETOUCH_TESSELLATION_FITTED_CURVE
#define FORETOUCH_TESSELLATION_FITTED_CURVE
namespace foretouch::internal {
/// Sizes of a curve's polynomials, as computed in double.
struct FittedCurve {
  double weighted = 0.0;      ///< Sum of (2j+2)|c_j| over the coefficients' vectors.
  double speed = 0.0;         ///< Largest |control point| of the first derivative
  double acceleration = 0.0;  ///< and of the second.
};
/// Rows of coordinates at the nodes, and rows made from them.
struct CurveRows {
  const double (*samples)[kNodes];
  float (*coefficients)[kCoefficients];
  int count;  ///< At most kMaxRows.
};
constexpr int kMaxRows = 9;
}  // namespace foretouch::internal
#endif

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

using internal::CurveRows;
using internal::FittedCurve;
using internal::PolynomialMatrices;

HWY_INLINE FittedCurve fitted(const PolynomialMatrices& matrices, const CurveRows& rows) {
  const NodeLanes d;
  const hn::Rebind<float, NodeLanes> floats;
  alignas(64) double rounded[internal::kMaxRows][kNodes];
  NodeVector weighted = hn::Zero(d);
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    NodeVector square = hn::Zero(d);
    for (int row = 0; row < rows.count; ++row) {
      const NodeVector c = combined(d, rows.samples[row], matrices.coefficients, 0, lane);
      const auto single = hn::DemoteTo(floats, c);
      hn::StoreU(single, floats, rows.coefficients[row] + lane);
      hn::Store(hn::PromoteTo(d, single), d, rounded[row] + lane);
      square = hn::MulAdd(c, c, square);
    }
    weighted = hn::MulAdd(hn::Sqrt(square), hn::Load(d, matrices.evaluation + lane), weighted);
  }
  FittedCurve curve;
  curve.weighted = hn::GetLane(hn::SumOfLanes(d, weighted));
  curve.speed = largestNorm(rounded, rows.count, matrices.first, 1);
  curve.acceleration = largestNorm(rounded, rows.count, matrices.second, 2);
  return curve;
}

FittedCurve fitPoint(const PolynomialMatrices& matrices, const LinkNodes& link, const double* p_L,
                     const double* origin, float (*coefficients)[kCoefficients]) {
  const NodeLanes d;
  alignas(64) double samples[3][kNodes];
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
      hn::Store(pointAt(d, link, p_L, origin[axis], axis, lane), d, samples[axis] + lane);
    }
  }
  return fitted(matrices, {samples, coefficients, 3});
}

FittedCurve fitRotation(const PolynomialMatrices& matrices, const LinkNodes& link,
                        float (*coefficients)[kCoefficients]) {
  return fitted(matrices, {link.R, coefficients, 9});
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(fitPoint);
HWY_EXPORT(fitRotation);

using internal::FittedCurve;
using internal::floatPaddedAbove;
using internal::kControlRounding;
using internal::kFitting;
using internal::kInflation;
using internal::kInstantRounding;
using internal::kLebesgue;
using internal::kUnitRoundoffOfFloat;
using internal::polynomialMatrices;

// Derived in tessellation/lss_polynomials.md 3 and 4; checked by
// tests/tessellation/lss_polynomials_test.cpp.
constexpr double kEvaluation = 1.0 + 1e-5;      ///< Products of two roundings in float.
constexpr double kPolynomialUnderflow = 1e-36;  ///< The loss in a few dozen products in float (m).
/// A matrix times a vector in float, the vector rounded, for a matrix that is a rotation within
/// 1e-3; and adding the origin. In units of its roundoff.
constexpr double kFloatPoint = 9.0, kFloatSum = 4.1;

/// How far the curve in float is from the curve through the samples, everywhere.
double evaluationError(const FittedCurve& curve) {
  return (kUnitRoundoffOfFloat * kEvaluation + kFitting * kUnitRoundoff) * curve.weighted +
         kPolynomialUnderflow;
}

/// How far the sampled points may be from the true ones at the nodes of the formula.
double sampleError(const ChainMotion& motion, const ChainNodes& nodes, LinkId link, double rho) {
  return internal::pointRounding(nodes.bounds(), rho) +
         motion.bounds(link).speedAt(rho) * kInstantRounding;
}

double pointError(const FittedCurve& curve, const ChainMotion& motion, const ChainNodes& nodes,
                  LinkId link, double rho) {
  const double span = nodes.end() - nodes.begin();
  return (interpolationError(motion.bounds(link), rho, span) +
          kLebesgue * sampleError(motion, nodes, link, rho) + evaluationError(curve)) *
         kInflation;
}

float speedOf(const FittedCurve& curve) {
  return floatPaddedAbove((curve.speed + kControlRounding * curve.weighted) * kInflation +
                          kPolynomialUnderflow);
}
float accelerationOf(const FittedCurve& curve) {
  return floatPaddedAbove((curve.acceleration + kControlRounding * curve.weighted) * kInflation +
                          kPolynomialUnderflow);
}

/// A node near the middle of the span.
constexpr int kMiddle = kNodes / 2;

/// The float nearest to the place of `p_L` in the middle of the span.
void placeOrigin(const LinkNodes& link, const double* p_L, double* origin) {
  for (int i = 0; i < 3; ++i) {
    double sum = link.p[i][kMiddle];
    for (int j = 0; j < 3; ++j) sum += link.R[3 * i + j][kMiddle] * p_L[j];
    origin[i] = nearestFloat(sum);
  }
}

}  // namespace

LssPolynomials polynomialsOf(const LssTable::Entry& entry, const ChainMotion& motion,
                             const ChainNodes& nodes) {
  const LinkNodes& link = nodes.link(entry.link);
  double middle[3];
  for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (entry.a[i] + entry.b[i]);
  LssPolynomials result;
  placeOrigin(link, middle, result.origin);
  const FittedCurve a =
      HWY_DYNAMIC_DISPATCH(fitPoint)(polynomialMatrices(), link, entry.a, result.origin, result.a);
  const FittedCurve b =
      HWY_DYNAMIC_DISPATCH(fitPoint)(polynomialMatrices(), link, entry.b, result.origin, result.b);
  const double error = std::max(pointError(a, motion, nodes, entry.link, entry.rhoA),
                                pointError(b, motion, nodes, entry.link, entry.rhoB));
  result.radius = floatPaddedAbove((entry.radius + error) * kInflation);
  result.speedA = speedOf(a);
  result.speedB = speedOf(b);
  result.accelerationA = accelerationOf(a);
  result.accelerationB = accelerationOf(b);
  // Twice a float's rounding covers the coefficients', and that of the sum.
  result.weighted =
      floatPaddedAbove(std::max(a.weighted, b.weighted) * (1.0 + 2.0 * kUnitRoundoffOfFloat));
  return result;
}

constexpr double kLinksOwnOrigin[3] = {0.0, 0.0, 0.0};

FramePolynomials framePolynomialsOf(LinkId link, const ChainMotion& motion,
                                    const ChainNodes& nodes) {
  double origin[3];
  placeOrigin(nodes.link(link), kLinksOwnOrigin, origin);
  return framePolynomialsOf(link, motion, nodes, origin);
}

FramePolynomials framePolynomialsOf(LinkId link, const ChainMotion& motion, const ChainNodes& nodes,
                                    const double* origin) {
  const LinkNodes& frames = nodes.link(link);
  FramePolynomials result;
  std::copy_n(origin, 3, result.origin);
  const FittedCurve p = HWY_DYNAMIC_DISPATCH(fitPoint)(polynomialMatrices(), frames, kLinksOwnOrigin,
                                                       result.origin, result.p);
  const FittedCurve R = HWY_DYNAMIC_DISPATCH(fitRotation)(polynomialMatrices(), frames, result.R);
  const MotionBounds& bounds = motion.bounds(link);
  MotionBounds turning;  // those of a unit vector of the link
  turning.angularSpeed = bounds.angularSpeed;
  const double rotationError =
      interpolationError(turning, 1.0, nodes.end() - nodes.begin()) +
      kLebesgue * (nodes.bounds().rotationRounding + bounds.angularSpeed * kInstantRounding) +
      evaluationError(R) + kFloatPoint * kUnitRoundoffOfFloat;
  const double originError = pointError(p, motion, nodes, link, 0.0) +
                             kFloatSum * kUnitRoundoffOfFloat * p.weighted + kPolynomialUnderflow;
  result.rotationError = floatPaddedAbove(rotationError * kEvaluation);
  result.originError = floatPaddedAbove(originError * kInflation);
  result.originSpeed = speedOf(p);
  result.rotationSpeed = speedOf(R);
  result.originAcceleration = accelerationOf(p);
  result.rotationAcceleration = accelerationOf(R);
  return result;
}

}  // namespace foretouch
#endif
