#include "middleware/lanes/blend_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/blend_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tessellation/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Powers = hn::CappedTag<float, kCoefficients>;
using Columns = hn::CappedTag<float, BlendTriangle::kColumns>;
using foretouch::HWY_NAMESPACE::NodeLanes;
using foretouch::HWY_NAMESPACE::NodeVector;
using foretouch::HWY_NAMESPACE::pointAt;

/// Sum of the shares' weight * p + R * arm, each link relative to its own origin.
void sumShares(const BlendFrame* frames, const LaneBlend& blend, float (*c)[kCoefficients]) {
  const Powers d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  for (int k = 0; k < kCoefficients; k += lanes) {
    auto x = hn::Zero(d), y = x, z = x;
    for (int i = 0; i < blend.count; ++i) {
      const LaneShare& share = blend.shares[i];
      const FramePolynomials& frame = frames[share.link].polynomials;
      const auto weight = hn::Set(d, share.laneWeight);
      x = hn::MulAdd(weight, hn::LoadU(d, frame.p[0] + k), x);
      y = hn::MulAdd(weight, hn::LoadU(d, frame.p[1] + k), y);
      z = hn::MulAdd(weight, hn::LoadU(d, frame.p[2] + k), z);
      for (int j = 0; j < 3; ++j) {
        const auto arm = hn::Set(d, share.arm[j]);
        x = hn::MulAdd(arm, hn::LoadU(d, frame.R[j] + k), x);
        y = hn::MulAdd(arm, hn::LoadU(d, frame.R[3 + j] + k), y);
        z = hn::MulAdd(arm, hn::LoadU(d, frame.R[6 + j] + k), z);
      }
    }
    hn::StoreU(x, d, c[0] + k);
    hn::StoreU(y, d, c[1] + k);
    hn::StoreU(z, d, c[2] + k);
  }
}

/// Columns `first` on at `u`, by Horner's rule.
HWY_INLINE void evaluate(Columns d, const BlendTriangle& triangle, int first, float instant,
                         float* at, float* rate) {
  const auto u = hn::Set(d, instant);
  auto slope = hn::Load(d, triangle.c[kCoefficients - 1] + first);
  auto place = hn::MulAdd(slope, u, hn::Load(d, triangle.c[kCoefficients - 2] + first));
  for (int k = kCoefficients - 3; k >= 0; --k) {
    slope = hn::MulAdd(slope, u, place);
    place = hn::MulAdd(place, u, hn::Load(d, triangle.c[k] + first));
  }
  hn::Store(place, d, at + first);
  hn::Store(slope, d, rate + first);
}

void placeLanes(const BlendTriangle* triangles, const std::int32_t* which, const float* u,
                std::size_t count, TrianglePairBlock& pairs) {
  const Columns d;
  constexpr int kUsed = 9;
  alignas(64) float at[BlendTriangle::kColumns], rate[BlendTriangle::kColumns];
  for (std::size_t lane = 0; lane < count; ++lane) {
    const BlendTriangle& triangle = triangles[which[lane]];
    for (int first = 0; first < kUsed; first += static_cast<int>(hn::Lanes(d))) {
      evaluate(d, triangle, first, u[lane], at, rate);
    }
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        pairs.link[i][axis][lane] = at[3 * i + axis];
        pairs.velocity[i][axis][lane] = rate[3 * i + axis];
      }
      pairs.acceleration[i][lane] = triangle.bounds.acceleration;
    }
    pairs.velocityPad[lane] = triangle.bounds.velocityPad;
  }
}

/// Adds one end of the axis.
HWY_INLINE void addEnd(const AxisShare* shares, int count, const double* AxisShare::*end, int lane,
                       NodeVector (&least)[3], NodeVector (&most)[3], NodeVector& spread) {
  const NodeLanes d;
  NodeVector first[3], sum[3];
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = pointAt(d, *shares[0].link, shares[0].*end, 0.0, axis, lane);
    sum[axis] = hn::Mul(hn::Set(d, shares[0].weight), first[axis]);
  }
  NodeVector apart = hn::Zero(d);
  for (int i = 1; i < count; ++i) {
    NodeVector square = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const NodeVector at = pointAt(d, *shares[i].link, shares[i].*end, 0.0, axis, lane);
      const NodeVector from = hn::Sub(at, first[axis]);
      square = hn::MulAdd(from, from, square);
      sum[axis] = hn::MulAdd(hn::Set(d, shares[i].weight), at, sum[axis]);
    }
    apart = hn::MulAdd(hn::Set(d, shares[i].spread), hn::Sqrt(square), apart);
  }
  spread = hn::Max(spread, apart);
  for (int axis = 0; axis < 3; ++axis) {
    least[axis] = hn::Min(least[axis], sum[axis]);
    most[axis] = hn::Max(most[axis], sum[axis]);
  }
}

BlendExtent extentOf(const AxisShare* shares, int count) {
  const NodeLanes d;
  const NodeVector far = hn::Set(d, HUGE_VAL);
  NodeVector least[3] = {far, far, far};
  NodeVector most[3] = {hn::Neg(far), hn::Neg(far), hn::Neg(far)};
  NodeVector spread = hn::Zero(d);
  const bool isPoint = shares[0].a == shares[0].b;
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    addEnd(shares, count, &AxisShare::a, lane, least, most, spread);
    if (!isPoint) addEnd(shares, count, &AxisShare::b, lane, least, most, spread);
  }
  BlendExtent extent;
  for (int axis = 0; axis < 3; ++axis) {
    extent.least[axis] = hn::GetLane(hn::MinOfLanes(d, least[axis]));
    extent.most[axis] = hn::GetLane(hn::MaxOfLanes(d, most[axis]));
  }
  extent.spread = hn::GetLane(hn::MaxOfLanes(d, spread));
  return extent;
}

}  // namespace
}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {

HWY_EXPORT(sumShares);
HWY_EXPORT(placeLanes);
HWY_EXPORT(extentOf);

constexpr double kRoundoff = kUnitRoundoffOfFloat;
/// Outweighs the roundings of a bound's own operations in float: these, and so many per share.
constexpr double kBoundRoundings = 64.0, kShareRoundings = 8.0;
/// Underflow may cost a place (m) or a rate (m per u) this much (frame_lanes.md 3).
constexpr double kBlendUnderflow = 0x1p-90;

/// The rounding of the sums that make a box, relative to their terms: the proof needs 12 unit
/// roundoffs, of what then grows it again too.
constexpr float kBlendBoxRounding = 32.0F * kUnitRoundoffOfFloat;
constexpr float kBlendBoxInflation = 1.0F + 16.0F * kUnitRoundoffOfFloat;

/// Norms of rows of coefficients, power by power, weighted with the roundings of Horner's rule.
template <std::size_t kRows>
float weightedOf(const float (&rows)[kRows][kCoefficients]) {
  double sum = 0.0;
  for (int k = 0; k < kCoefficients; ++k) {
    double square = 0.0;
    for (const auto& row : rows) square += double{row[k]} * row[k];
    sum += (2.0 * k + 2.0) * std::sqrt(square);
  }
  return floatPaddedAbove(sum * kInflation);
}

/// What the shares' bounds add up to.
struct ShareSums {
  float error = 0.0F, weighted = 0.0F, speed = 0.0F, acceleration = 0.0F;
  double shift[3] = {0.0, 0.0, 0.0};  ///< That of the links' origins from the curve's.
};

ShareSums sumsOf(const BlendFrame* frames, const LaneBlend& blend, const double* origin) {
  ShareSums sums;
  for (int i = 0; i < blend.count; ++i) {
    const LaneShare& share = blend.shares[i];
    const BlendFrame& frame = frames[share.link];
    const float weight = share.laneWeight, reach = share.reach;
    sums.error += weight * frame.error.origin + reach * frame.error.turn;
    sums.weighted += weight * frame.weighted.origin + reach * frame.weighted.turn;
    sums.speed += weight * frame.speed.origin + reach * frame.speed.turn;
    sums.acceleration += weight * frame.acceleration.origin + reach * frame.acceleration.turn;
    for (int axis = 0; axis < 3; ++axis) {
      sums.shift[axis] += share.weight * (frame.polynomials.origin[axis] - origin[axis]);
    }
  }
  return sums;
}

double lengthOf(double x, double y, double z) {
  return std::sqrt(x * x + y * y + z * z);
}

/// `first`: how long the constant coefficient is, once shifted (blend_lanes.md 2).
BlendBounds boundsOf(const ShareSums& sums, int numShares, double first) {
  const double roundings = 4.0 * numShares + 2.0;  // of every term of a coefficient
  const double weighted = sums.weighted,
               shift = lengthOf(sums.shift[0], sums.shift[1], sums.shift[2]);
  const double terms = kRoundoff * weighted;
  const double inflation = 1.0 + (kBoundRoundings + kShareRoundings * numShares) * kRoundoff;
  BlendBounds bounds;
  bounds.positionPad = floatAbove(
      (sums.error + (0.5 * roundings + 1.0) * terms + 3.0 * kRoundoff * (shift + first)) *
          inflation +
      kBlendUnderflow);
  bounds.velocityPad = floatAbove(10.0 * terms * inflation + kBlendUnderflow);
  bounds.speed = floatAbove((sums.speed + 0.5 * roundings * terms) * inflation + kBlendUnderflow);
  bounds.acceleration =
      floatAbove((sums.acceleration + 2.625 * roundings * terms) * inflation + kBlendUnderflow);
  bounds.weighted = floatAbove((weighted + 2.0 * first) * inflation + kBlendUnderflow);
  return bounds;
}

BlendBounds largerOf(const BlendBounds& x, const BlendBounds& y) {
  return {std::max(x.positionPad, y.positionPad), std::max(x.velocityPad, y.velocityPad),
          std::max(x.speed, y.speed), std::max(x.acceleration, y.acceleration),
          std::max(x.weighted, y.weighted)};
}

}  // namespace

BlendFrame blendFrame(const FramePolynomials& polynomials) {
  BlendFrame frame;
  frame.polynomials = polynomials;
  frame.error = {polynomials.originError, polynomials.rotationError};
  frame.weighted = {weightedOf(polynomials.p), weightedOf(polynomials.R)};
  frame.speed = {polynomials.originSpeed, polynomials.rotationSpeed};
  frame.acceleration = {polynomials.originAcceleration, polynomials.rotationAcceleration};
  return frame;
}

LaneShare laneShare(std::int32_t link, double weight, const double* p_L) {
  LaneShare share{};
  share.weight = weight;
  share.laneWeight = static_cast<float>(weight);
  for (int axis = 0; axis < 3; ++axis) share.arm[axis] = static_cast<float>(weight * p_L[axis]);
  share.reach = floatAbove(weight * lengthOf(p_L[0], p_L[1], p_L[2]) * kInflation);
  share.link = link;
  return share;
}

BlendPoint blendPoint(const BlendFrame* frames, const LaneBlend& blend, const double* origin) {
  BlendPoint point;
  HWY_DYNAMIC_DISPATCH(sumShares)(frames, blend, point.c);
  const ShareSums sums = sumsOf(frames, blend, origin);
  for (int axis = 0; axis < 3; ++axis) point.c[axis][0] += static_cast<float>(sums.shift[axis]);
  point.bounds = boundsOf(sums, blend.count, lengthOf(point.c[0][0], point.c[1][0], point.c[2][0]));
  return point;
}

void blendTriangle(const BlendFrame* frames, const LaneBlend (&corners)[3], const double* origin,
                   BlendTriangle& triangle) {
  triangle.bounds = {};
  for (int i = 0; i < 3; ++i) {
    const BlendPoint point = blendPoint(frames, corners[i], origin);
    triangle.bounds = largerOf(triangle.bounds, point.bounds);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < kCoefficients; ++k) triangle.c[k][3 * i + axis] = point.c[axis][k];
    }
  }
}

BlendHull blendHull(const BlendTriangle& triangle, float pad, float radius) {
  BlendHull hull{pad, radius, {}, {}};
  constexpr float kEmpty = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    CurveBox &swept = hull.swept, &start = hull.start;
    swept.lower[axis] = start.lower[axis] = kEmpty;
    swept.upper[axis] = start.upper[axis] = -kEmpty;
    for (int column = axis; column < 9; column += 3) {
      const float middle = triangle.c[0][column];
      float way = 0.0F, from = middle;
      for (int k = 1; k < kCoefficients; ++k) {
        const float c = triangle.c[k][column];
        way += std::abs(c);
        from += k % 2 == 0 ? c : -c;
      }
      const float grown =
          (pad + radius + kBlendBoxRounding * (way + std::abs(middle))) * kBlendBoxInflation;
      swept.lower[axis] = std::min(swept.lower[axis], middle - (way + grown));
      swept.upper[axis] = std::max(swept.upper[axis], middle + (way + grown));
      start.lower[axis] = std::min(start.lower[axis], from - grown);
      start.upper[axis] = std::max(start.upper[axis], from + grown);
    }
  }
  return hull;
}

void placeBlends(const BlendTriangle* triangles, const std::int32_t* which, const PairFloats& u,
                 std::size_t count, TrianglePairBlock& pairs) {
  HWY_DYNAMIC_DISPATCH(placeLanes)(triangles, which, u, count, pairs);
}

BlendExtent blendExtent(const AxisShare* shares, int count) {
  return HWY_DYNAMIC_DISPATCH(extentOf)(shares, count);
}

}  // namespace foretouch::internal
#endif
