#include "middleware/query/link_pair.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"
#include "lss/triangle_separation.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PairState pairOfLss(const Lss& lss, const AxisBounds& bounds, const LinkState& state,
                    const Triangle& triangle) {
  const AxisEnds ends = axisEnds(lss, state);
  const Separation axis = separation(ends.a, ends.b, triangle);
  // The differences below round once each, by at most kUnitRoundoff of the subtracted values.
  const double radiusSlack = 4.0 * kUnitRoundoff * (lss.radius + std::abs(axis.upper));
  PairState pair;
  pair.points = 2;
  pair.radius = lss.radius;
  pair.nhat = axis.nhat;
  pair.gap = {axis.clearanceA - bounds.positionRoundingA - lss.radius - radiusSlack,
              axis.clearanceB - bounds.positionRoundingB - lss.radius - radiusSlack, kInfinity};
  pair.gapUpper = axis.upper + std::max(bounds.positionRoundingA, bounds.positionRoundingB) -
                  lss.radius + radiusSlack;
  pair.distance = axis.closest.distance;
  pair.onHull = axis.closest.onSegment;
  pair.onScene = axis.closest.onTriangle;
  pair.difference = axis.closest.difference;
  pair.featureNormal = axis.closest.featureNormal;
  pair.velocity[0] = state.velocityAt(lss.a);
  pair.velocity[1] = state.velocityAt(lss.b);
  pair.acceleration = {bounds.accelerationA, bounds.accelerationB, 0.0};
  pair.velocityRounding = {bounds.velocityRoundingA, bounds.velocityRoundingB, 0.0};
  return pair;
}

PairState pairOfTriangle(const MovingTriangle& part, const Triangle& triangle) {
  const TriangleSeparation s = triangleSeparation(part.triangle, triangle);
  PairState pair;
  pair.points = 3;
  pair.nhat = s.nhat;
  pair.hull = part.triangle;
  pair.velocity = part.velocity;
  pair.acceleration = part.acceleration;
  pair.velocityRounding = part.velocityRounding;
  double worstRounding = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    worstRounding = std::max(worstRounding, part.positionRounding[i]);
    pair.gap[i] =
        s.clearance[i] - part.positionRounding[i] - 4.0 * kUnitRoundoff * std::abs(s.clearance[i]);
  }
  pair.gapUpper = (s.upper + worstRounding) * kInflation;
  pair.distance = s.distance;
  pair.onHull = s.onOne;
  pair.onScene = s.onOther;
  pair.difference = s.difference;
  pair.featureNormal = s.featureNormal;
  return pair;
}

/// Adds one link's share of a skinned vertex. Sums of a handful of terms: twice the rounding of a
/// point for each covers the products and the sum.
void addInfluence(const SkinInfluence& influence, const LinkState& state,
                  const MotionBounds& bounds, std::size_t corner, MovingTriangle& moving) {
  const double w = influence.weight, rho = influence.p_L.norm() * kInflation;
  moving.triangle.vertices[corner] += w * state.pointAt(influence.p_L);
  moving.velocity[corner] += w * state.velocityAt(influence.p_L);
  moving.acceleration[corner] += w * bounds.accelerationAt(rho) * kInflation;
  moving.positionRounding[corner] += 2.0 * w * bounds.positionRoundingAt(rho) * kInflation;
  moving.velocityRounding[corner] += 2.0 * w * bounds.velocityRoundingAt(rho) * kInflation;
}

}  // namespace

double PairState::gapLower() const {
  return std::min(gap[0], points == 3 ? std::min(gap[1], gap[2]) : gap[1]);
}

const Lss& LinkParts::lssOf(std::int32_t lssIndex, Part part) const {
  FORETOUCH_ASSERT(!part.isTriangle());
  const auto index = slotOf(lssIndex);
  return part.isWhole() ? lss[index] : surface->hierarchy(lssIndex).node(part.index()).lss;
}

MovingTriangle LinkParts::movingTriangle(std::int32_t index, const PosedLink& posed) const {
  MovingTriangle moving;
  if (skin != nullptr) {
    moving.acceleration = moving.positionRounding = moving.velocityRounding = {};
    for (std::size_t i = 0; i < 3; ++i) {
      moving.triangle.vertices[i].setZero();
      moving.velocity[i].setZero();
      const std::int32_t vertex = skin->triangle(link, index)[i];
      for (const SkinInfluence& influence : skin->skin.vertices[slotOf(vertex)]) {
        addInfluence(influence, posed.all[slotOf(influence.link)], motion.bounds(influence.link), i,
                     moving);
      }
    }
    return moving;
  }
  const MotionBounds& bounds = motion.bounds(link);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& p_L = surface->triangle(index).vertices[i];
    const double rho = p_L.norm() * kInflation;
    moving.triangle.vertices[i] = posed.state.pointAt(p_L);
    moving.velocity[i] = posed.state.velocityAt(p_L);
    moving.acceleration[i] = bounds.accelerationAt(rho) * kInflation;
    moving.positionRounding[i] = bounds.positionRoundingAt(rho) * kInflation;
    moving.velocityRounding[i] = bounds.velocityRoundingAt(rho) * kInflation;
  }
  return moving;
}

PairState LinkParts::pair(std::int32_t lssIndex, Part part, const PosedLink& posed,
                          const Triangle& triangle) const {
  if (part.isTriangle()) return pairOfTriangle(movingTriangle(part.index(), posed), triangle);
  const auto index = slotOf(lssIndex);
  if (part.isWhole()) return pairOfLss(lss[index], axisBounds[index], posed.state, triangle);
  const Lss& node = lssOf(lssIndex, part);
  return pairOfLss(node, foretouch::axisBounds(node, motion.bounds(link)), posed.state, triangle);
}

double LinkParts::stepByPlane(std::int32_t lssIndex, Part part, const LinkState& state,
                              const Triangle& triangle, const Vector3d& nhat, double floor) const {
  const MotionBounds& bounds = motion.bounds(link);
  std::array<Vector3d, 3> points_L;
  std::size_t count = 3;
  double radius = 0.0;
  if (part.isTriangle()) {
    points_L = surface->triangle(part.index()).vertices;
  } else {
    const Lss& bound = lssOf(lssIndex, part);
    points_L = {bound.a, bound.b, Vector3d::Zero()};
    count = 2;
    radius = bound.radius;
  }
  const Vector3d& origin = triangle.vertices[0];
  const Vector3d e1 = triangle.vertices[1] - origin, e2 = triangle.vertices[2] - origin;
  const double top = std::max(0.0, std::max(nhat.dot(e1), nhat.dot(e2)));
  const double extentOfTriangle = e1.lpNorm<1>() + e2.lpNorm<1>();
  double step = kInfinity;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d w = state.pointAt(points_L[i]) - origin;
    const double rho = points_L[i].norm() * kInflation;
    const double slack = kSeparationRounding * (w.lpNorm<1>() + extentOfTriangle + radius) +
                         bounds.positionRoundingAt(rho) * kInflation;
    const double gap = nhat.dot(w) - top - radius - slack;
    if (!(gap > floor)) return 0.0;
    const double speed =
        nhat.dot(state.velocityAt(points_L[i])) - bounds.velocityRoundingAt(rho) * kInflation;
    step = std::min(step, safeStep(gap - floor, speed, bounds.accelerationAt(rho) * kInflation));
  }
  return step;
}

Aabb LinkParts::boxOfPoints(std::int32_t lssIndex, Part part, const PosedLink& posed) const {
  Aabb box;
  if (part.isTriangle()) {
    for (const Vector3d& v : movingTriangle(part.index(), posed).triangle.vertices) box.add(v);
    return box;
  }
  const AxisEnds ends = axisEnds(lssOf(lssIndex, part), posed.state);
  box.add(ends.a);
  box.add(ends.b);
  return box;
}

double stepFrom(const PairState& pair, double floor) {
  if (!(pair.gapLower() > floor)) return 0.0;
  double step = kInfinity;
  for (std::size_t i = 0; i < pair.points; ++i) {
    const double speed = pair.nhat.dot(pair.velocity[i]) - pair.velocityRounding[i];
    step = std::min(step, safeStep(pair.gap[i] - floor, speed, pair.acceleration[i]));
  }
  return step;
}

}  // namespace foretouch::internal
