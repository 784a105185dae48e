#include "judge/cast_oracle.h"

#include <algorithm>
#include <cmath>

#include "judge/distance.h"

namespace foretouch::oracle {
namespace {

/// The golden section leaves 0.618^110 = 1e-23 of a way; halves as many.
constexpr int kSections = 110;
constexpr int kHalvings = 80;

Vec3r unitOf(const Vec3d& direction) {
  const Real size = static_cast<Real>(extent(direction));
  if (size == 0) return {};
  const Vec3r scaled = (1 / size) * direction.as<Real>();
  return (1 / norm(scaled)) * scaled;
}

Corners<Real> cornersOf(const OraclePart& part) {
  return {part.corners[0].as<Real>(), part.corners[1].as<Real>(),
          part.corners[part.count == 3 ? 2 : 1].as<Real>()};
}

Real axisGap(const Vec3r& a, const Vec3r& b, const OraclePart& part) {
  const Corners<Real> corners = cornersOf(part);
  if (part.count == 3) return closestPoints(a, b, corners).distance;
  return closestPoints(Corners<Real>{a, b, b}, corners).distance;
}

/// From a ball around the part to the line that a ball around the shape moves along.
Real gapOfBalls(const CastShape& shape, const Vec3r& way, Real until, const OraclePart& part) {
  const Vec3r a = shape.a.as<Real>(), b = shape.b.as<Real>();
  const Vec3r middle = Real(0.5) * (a + b);
  const Corners<Real> corners = cornersOf(part);
  const Vec3r centre = (Real(1) / 3) * (corners[0] + corners[1] + corners[2]);
  Real radius = 0;
  for (const Vec3r& corner : corners) radius = std::max(radius, norm(corner - centre));
  const Real between = pointSegmentDistance(centre, middle, middle + until * way);
  return between - radius - norm(a - middle) - static_cast<Real>(shape.radius) -
         static_cast<Real>(part.radius);
}

struct Least {
  Real gap, along;
};

}  // namespace

Real gapAfter(const CastShape& shape, Real along, const OraclePart& part) {
  const Vec3r moved = along * unitOf(shape.direction);
  return axisGap(shape.a.as<Real>() + moved, shape.b.as<Real>() + moved, part) -
         static_cast<Real>(shape.radius) - static_cast<Real>(part.radius);
}

namespace {

Least leastOf(const CastShape& shape, Real until, const OraclePart& part) {
  const Real golden = (std::sqrt(Real(5)) - 1) / 2;
  Least least{gapAfter(shape, 0, part), 0};
  const auto look = [&](Real along) {
    const Real gap = gapAfter(shape, along, part);
    if (gap < least.gap) least = {gap, along};
    return gap;
  };
  look(until);
  Real low = 0, high = until;
  Real left = high - golden * (high - low), right = low + golden * (high - low);
  Real atLeft = look(left), atRight = look(right);
  for (int i = 0; i < kSections && low < high; ++i) {
    if (atLeft < atRight) {
      high = right;
      right = left;
      atRight = atLeft;
      left = high - golden * (high - low);
      atLeft = look(left);
    } else {
      low = left;
      left = right;
      atLeft = atRight;
      right = low + golden * (high - low);
      atRight = look(right);
    }
  }
  return least;
}

}  // namespace

Real leastGap(const CastShape& shape, Real until, const OraclePart& part, Real beyond) {
  if (gapOfBalls(shape, unitOf(shape.direction), until, part) > beyond + 1e-6L) {
    return beyond + 1e-6L;
  }
  return leastOf(shape, until, part).gap;
}

Real firstTouch(const CastShape& shape, Real until, const OraclePart& part) {
  if (gapOfBalls(shape, unitOf(shape.direction), until, part) > 0) return -1;
  const Least least = leastOf(shape, until, part);
  if (least.gap > 0) return -1;
  Real free = 0, touching = least.along;
  if (gapAfter(shape, free, part) <= 0) return 0;
  for (int i = 0; i < kHalvings; ++i) {
    const Real middle = (free + touching) / 2;
    (gapAfter(shape, middle, part) > 0 ? free : touching) = middle;
  }
  return touching;
}

Real heightOver(const Vec3d& p, const OraclePart& part) {
  return axisGap(p.as<Real>(), p.as<Real>(), part) - static_cast<Real>(part.radius);
}

}  // namespace foretouch::oracle
