// tests/support/oracle_certificate.h: what one look at a moving segment or triangle and a triangle
// at rest proves about the span of time around it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "tests/support/oracle_distance.h"

namespace foretouch::oracle {

/// The hull of `count` points, and what they may do within the half span.
template <typename S>
struct HullView {
  std::size_t count = 2;  ///< 2 or 3.
  std::array<Vec3<S>, 3> points, velocity;
  std::array<S, 3> bend{};  ///< acceleration * halfSpan^2 / 2
  S stray = 0;              ///< How far any of the points can get from here.
  S halfSpan = 0;
};

template <typename S>
struct Certificate {
  S distance = 0;  ///< At the middle.
  S least = 0;     ///< Proved lower bound of the distance over the span.
};

template <typename S>
Closest<S> closestPoints(const HullView<S>& hull, const std::array<Vec3<S>, 3>& corners) {
  return hull.count == 3 ? closestPoints(hull.points, corners)
                         : closestPoints(hull.points[0], hull.points[1], corners);
}

/// The plane through the triangle's foremost corner along n, the direction of the closest points:
/// the hull stays in front of it by at least what its points do, and a point's height over it
/// changes by at most |n.v| h + A h^2 / 2. Any unit n gives a valid bound; this one is nearly the
/// best.
template <typename S>
Certificate<S> certify(const HullView<S>& hull, const std::array<Vec3<S>, 3>& corners) {
  using std::abs;
  const Closest<S> closest = closestPoints(hull, corners);
  Certificate<S> c{closest.distance, closest.distance - hull.stray};
  if (!(closest.distance > 0)) return c;
  const Vec3<S> n = S(1 / closest.distance) * (closest.onSegment - closest.onTriangle);
  S front = dot(n, corners[0]);
  for (const Vec3<S>& corner : corners) front = std::max(front, dot(n, corner));
  S low = std::numeric_limits<S>::infinity();
  for (std::size_t i = 0; i < hull.count; ++i) {
    const S change = abs(dot(n, hull.velocity[i])) * hull.halfSpan + hull.bend[i];
    low = std::min(low, S(dot(n, hull.points[i]) - change));
  }
  c.least = std::max(c.least, S(low - front));
  return c;
}

}  // namespace foretouch::oracle
