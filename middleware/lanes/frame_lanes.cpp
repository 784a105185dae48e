#include "middleware/lanes/frame_lanes.h"

#include <algorithm>
#include <cmath>

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/frame_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kTrianglePairLanes>;
using Lanes = hn::Vec<Floats>;

/// Outweighs the roundings of a bound's own product and sums, of the points' coordinates, and the
/// second-order terms of the frame's bound.
constexpr float kBoundInflation = 1.0F + 16.0F * kUnitRoundoffOfFloat;

struct Value {
  Lanes at, rate;
};

/// A polynomial and its derivative, by Horner's rule.
HWY_INLINE Value evaluated(Floats d, const float (&c)[kCoefficients], Lanes u) {
  Lanes rate = hn::Set(d, c[kCoefficients - 1]);
  Lanes at = hn::MulAdd(rate, u, hn::Set(d, c[kCoefficients - 2]));
  for (int k = kCoefficients - 3; k >= 0; --k) {
    rate = hn::MulAdd(rate, u, at);
    at = hn::MulAdd(at, u, hn::Set(d, c[k]));
  }
  return {at, rate};
}

/// (origin + turn*rho), rounded up.
HWY_INLINE Lanes bound(Floats d, float origin, float turn, Lanes rho) {
  return hn::Mul(hn::Set(d, kBoundInflation),
                 hn::MulAdd(hn::Set(d, turn), rho, hn::Set(d, origin)));
}

/// One axis of all three points.
HWY_INLINE void placeAxis(Floats d, const LaneFrame& frame, const PartBlock& parts,
                          std::size_t first, int axis, Lanes u, TrianglePairBlock& pairs) {
  const Value origin = evaluated(d, frame.p[axis], u);
  const Value x = evaluated(d, frame.R[3 * axis], u);
  const Value y = evaluated(d, frame.R[3 * axis + 1], u);
  const Value z = evaluated(d, frame.R[3 * axis + 2], u);
  for (int i = 0; i < 3; ++i) {
    const Lanes px = hn::Load(d, parts.point[i][0] + first);
    const Lanes py = hn::Load(d, parts.point[i][1] + first);
    const Lanes pz = hn::Load(d, parts.point[i][2] + first);
    const Lanes at = hn::MulAdd(x.at, px, hn::MulAdd(y.at, py, hn::MulAdd(z.at, pz, origin.at)));
    const Lanes rate =
        hn::MulAdd(x.rate, px, hn::MulAdd(y.rate, py, hn::MulAdd(z.rate, pz, origin.rate)));
    hn::Store(at, d, pairs.link[i][axis] + first);
    hn::Store(rate, d, pairs.velocity[i][axis] + first);
  }
}

void placeLanes(const LaneFrame& frame, const PartBlock& parts, std::size_t count,
                TrianglePairBlock& pairs) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += lanes) {
    const Lanes u = hn::Load(d, parts.u + first);
    for (int axis = 0; axis < 3; ++axis) placeAxis(d, frame, parts, first, axis, u, pairs);
    const Lanes rho = hn::Load(d, parts.rho + first);
    const Lanes acceleration = bound(d, frame.originAcceleration, frame.turnAcceleration, rho);
    for (auto& ofPoint : pairs.acceleration) hn::Store(acceleration, d, ofPoint + first);
    const Lanes off =
        hn::Add(bound(d, frame.originPad, frame.turnPad, rho), hn::Load(d, parts.scenePad + first));
    hn::Store(hn::Mul(hn::Set(d, kBoundInflation), off), d, pairs.positionPad + first);
    hn::Store(bound(d, frame.originVelocityPad, frame.turnVelocityPad, rho), d,
              pairs.velocityPad + first);
  }
}

}  // namespace
}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {

HWY_EXPORT(placeLanes);

/// The rounding of a velocity, relative to the sums of its terms' absolute values: the proof needs
/// 17.2 unit roundoffs.
constexpr double kRateRounding = 20.0 * kUnitRoundoffOfFloat;

/// Sum of k |c_k|, which bounds the derivative's terms on [-1,1].
double rateTerms(const float (&c)[kCoefficients]) {
  double sum = 0.0;
  for (int k = 1; k < kCoefficients; ++k) sum += k * std::abs(static_cast<double>(c[k]));
  return sum;
}

template <std::size_t kRows>
double rateRounding(const float (&rows)[kRows][kCoefficients]) {
  double squares = 0.0;
  for (const auto& row : rows) squares += rateTerms(row) * rateTerms(row);
  return kRateRounding * std::sqrt(squares) * kInflation + kFrameUnderflow;
}

void setPoint(const Eigen::Vector3d& p, float (&point)[3], double& rho) {
  for (int axis = 0; axis < 3; ++axis) point[axis] = static_cast<float>(p[axis]);
  rho = std::max(rho, p.norm());
}

}  // namespace

LaneFrame laneFrame(const FramePolynomials& polynomials) {
  LaneFrame frame{};
  std::copy_n(&polynomials.R[0][0], 9 * kCoefficients, &frame.R[0][0]);
  std::copy_n(&polynomials.p[0][0], 3 * kCoefficients, &frame.p[0][0]);
  frame.originPad = floatAbove(polynomials.originError + kFrameUnderflow);
  frame.turnPad = polynomials.rotationError;
  frame.originVelocityPad = floatAbove(rateRounding(polynomials.p));
  frame.turnVelocityPad = floatAbove(rateRounding(polynomials.R));
  frame.originAcceleration = floatAbove(polynomials.originAcceleration + kFrameUnderflow);
  frame.turnAcceleration = polynomials.rotationAcceleration;
  return frame;
}

LanePart lanePart(const Triangle& triangle_L) {
  LanePart part{};
  double rho = 0.0;
  for (int i = 0; i < 3; ++i) setPoint(triangle_L.vertices[i], part.point[i], rho);
  part.rho = floatAbove(rho * kInflation);
  return part;
}

LanePart lanePart(const Lss& lss_L) {
  LanePart part{};
  double rho = 0.0;
  setPoint(lss_L.a, part.point[0], rho);
  setPoint(lss_L.b, part.point[1], rho);
  setPoint(lss_L.b, part.point[2], rho);
  part.rho = floatAbove(rho * kInflation);
  part.radius = floatAbove(lss_L.radius);
  return part;
}

void placeParts(const LaneFrame& frame, const PartBlock& parts, std::size_t count,
                TrianglePairBlock& pairs) {
  HWY_DYNAMIC_DISPATCH(placeLanes)(frame, parts, count, pairs);
}

}  // namespace foretouch::internal
#endif
