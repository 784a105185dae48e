#include "middleware/pair/moving_pair.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/safe_step.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

double worstOf(const MovingHull& part, const std::array<double, 3>& rounding) {
  const double worst = std::max(rounding[0], rounding[1]);
  return part.hull.count == 3 ? std::max(worst, rounding[2]) : worst;
}

/// For how long point i of `one` stays `floor` or more above each point of `other`, along `nhat`.
double stepOfPoint(const MovingHull& one, std::size_t i, const MovingHull& other, double gap,
                   const std::array<double, 3>& spare, const Vector3d& nhat) {
  const double speed =
      nhat.dot(one.velocity[i]) - one.velocityRounding[i] - (one.radiusRate + other.radiusRate);
  const double bend = one.radiusBend + other.radiusBend;
  if (!other.moves) return safeStep(gap, speed, std::max(0.0, one.acceleration[i] + bend));
  double step = kInfinity;
  for (std::size_t j = 0; j < countOf(other.hull.count); ++j) {
    const double closing = nhat.dot(other.velocity[j]) + other.velocityRounding[j];
    const double acceleration = (one.acceleration[i] + other.acceleration[j]) * kInflation;
    step = std::min(step,
                    safeStep(gap + spare[j], speed - closing, std::max(0.0, acceleration + bend)));
  }
  return step;
}

}  // namespace

MovingHull MovingHull::of(const Lss& lss, const AxisBounds& bounds, const LinkState& state) {
  const AxisEnds ends = axisEnds(lss, state);
  MovingHull part;
  part.hull = Hull::segment(ends.a, ends.b);
  part.radius = lss.radius;
  part.moves = true;
  part.velocity[0] = state.velocityAt(lss.a);
  part.velocity[1] = state.velocityAt(lss.b);
  part.acceleration = {bounds.accelerationA, bounds.accelerationB, 0.0};
  part.positionRounding = {bounds.positionRoundingA, bounds.positionRoundingB, 0.0};
  part.velocityRounding = {bounds.velocityRoundingA, bounds.velocityRoundingB, 0.0};
  return part;
}

MovingPair movingPair(const MovingHull& one, const MovingHull& other) {
  MovingPair pair{one, other, separation(one.hull, other.hull), {}, 0.0};
  const double radii = one.radius + other.radius;
  const double otherRounding = worstOf(other, other.positionRounding);
  // For the sums with radii and roundings; the differences of clearances have theirs in the slack.
  const double sumRounding = 4.0 * kUnitRoundoff * (std::abs(radii) + std::abs(pair.axes.upper));
  for (std::size_t i = 0; i < countOf(one.hull.count); ++i) {
    pair.gap[i] =
        pair.axes.clearance[i] - (one.positionRounding[i] + otherRounding) - radii - sumRounding;
  }
  pair.gapUpper =
      pair.axes.upper + (worstOf(one, one.positionRounding) + otherRounding) - radii + sumRounding;
  return pair;
}

double MovingPair::gapLower() const {
  const double least = std::min(gap[0], gap[1]);
  return one.hull.count == 3 ? std::min(least, gap[2]) : least;
}

double MovingPair::stepFrom(double floor) const {
  if (!(gapLower() > floor)) return 0.0;
  double step = kInfinity;
  for (std::size_t i = 0; i < countOf(one.hull.count); ++i) {
    step = std::min(step, stepOfPoint(one, i, other, gap[i] - floor, axes.spare, axes.nhat));
  }
  return step;
}

double stepByPlane(const MovingHull& one, const MovingHull& other, const Vector3d& nhat,
                   double floor) {
  const Vector3d& origin = other.hull.points[0];
  const auto numOne = countOf(one.hull.count), numOther = countOf(other.hull.count);
  std::array<double, 3> height{}, spare{};
  double top = 0.0, extent = one.radius + other.radius;
  for (std::size_t j = 1; j < numOther; ++j) {
    const Vector3d edge = other.hull.points[j] - origin;
    height[j] = nhat.dot(edge);
    top = std::max(top, height[j]);
    extent += edge.lpNorm<1>();
  }
  for (std::size_t j = 0; j < numOther; ++j) spare[j] = top - height[j];
  const double otherRounding = worstOf(other, other.positionRounding);
  double step = kInfinity;
  for (std::size_t i = 0; i < numOne; ++i) {
    const Vector3d w = one.hull.points[i] - origin;
    const double slack =
        kSeparationRounding * (w.lpNorm<1>() + extent) + (one.positionRounding[i] + otherRounding);
    const double gap = nhat.dot(w) - top - (one.radius + other.radius) - slack;
    if (!(gap > floor)) return 0.0;
    step = std::min(step, stepOfPoint(one, i, other, gap - floor, spare, nhat));
  }
  return step;
}

}  // namespace foretouch::internal
