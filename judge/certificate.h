// judge/certificate.h: one look at a moving segment or triangle and a triangle at rest, or another
// that moves, and what it proves for the span of time around it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "judge/distance.h"
#include "judge/motion.h"

namespace foretouch::oracle {

/// The hull of `count` points, and bounds on their motion within the half span.
template <typename S>
struct HullView {
  std::size_t count = 2;  ///< 2 or 3. Of two points the third place repeats the second.
  Corners<S> points, velocity;
  std::array<S, 3> bend{};  ///< acceleration * halfSpan^2 / 2
  S stray = 0;              ///< How far any of the points can move.
  S halfSpan = 0;
};

template <typename S>
struct Certificate {
  S distance = 0;  ///< At the middle.
  S least = 0;     ///< Proved lower bound of the distance over the span.
};

template <typename S>
Closest<S> closestPoints(const HullView<S>& hull, const Corners<S>& corners) {
  return hull.count == 3 ? closestPoints(hull.points, corners)
                         : closestPoints(hull.points[0], hull.points[1], corners);
}

/// A hull of two points is a triangle without area.
template <typename S>
Closest<S> closestPoints(const HullView<S>& hull, const HullView<S>& other) {
  if (other.count == 3 || hull.count == 2) return closestPoints(hull, other.points);
  Closest<S> closest = closestPoints(other.points[0], other.points[1], hull.points);
  std::swap(closest.onSegment, closest.onTriangle);
  return closest;
}

/// The other side's corners, and how far they can move: one at rest, or another hull.
template <typename S>
const Corners<S>& cornersOn(const Corners<S>& triangle) {
  return triangle;
}
template <typename S>
const Corners<S>& cornersOn(const HullView<S>& hull) {
  return hull.points;
}
template <typename S>
S strayOf(const Corners<S>&) {
  return 0;
}
template <typename S>
S strayOf(const HullView<S>& hull) {
  return hull.stray;
}

/// How far in front of the plane through the triangle's foremost corner along the unit vector n the
/// hull stays: a point's height over it changes by at most |n.v| h + A h^2 / 2. Negative: it may
/// cross. A lower bound of the distance for any n.
template <typename S>
S clearanceAlong(const Vec3<S>& n, const HullView<S>& hull, const Corners<S>& corners) {
  using std::abs;
  S front = dot(n, corners[0]);
  for (const Vec3<S>& corner : corners) front = std::max(front, dot(n, corner));
  S low = S(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < hull.count; ++i) {
    const S change = abs(dot(n, hull.velocity[i])) * hull.halfSpan + hull.bend[i];
    low = std::min(low, S(dot(n, hull.points[i]) - change));
  }
  return low - front;
}

/// The same for two hulls that move: the difference of two points, one of each, changes along n by
/// at most |n.(v - w)| h + (A + B) h^2 / 2. Where both move alike, that is little.
template <typename S>
S clearanceAlong(const Vec3<S>& n, const HullView<S>& hull, const HullView<S>& other) {
  using std::abs;
  S least = S(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < hull.count; ++i) {
    for (std::size_t j = 0; j < other.count; ++j) {
      const S rate = abs(dot(n, hull.velocity[i] - other.velocity[j]));
      const S change = rate * hull.halfSpan + hull.bend[i] + other.bend[j];
      least = std::min(least, S(dot(n, hull.points[i] - other.points[j]) - change));
    }
  }
  return least;
}

/// The best of the normals of faces and of pairs of edges, both signs.
template <typename S, typename Other>
S clearanceAlongFeatures(const HullView<S>& hull, const Other& other) {
  const Corners<S>& corners = cornersOn(other);
  S best = S(-std::numeric_limits<double>::infinity());
  const auto offer = [&](const Vec3<S>& normal) {
    const S length = norm(normal);
    if (!(length > 0)) return;
    for (const int sign : {1, -1}) {
      best = std::max(best, clearanceAlong(S(S(sign) / length) * normal, hull, other));
    }
  };
  const auto& p = hull.points;
  offer(cross(corners[1] - corners[0], corners[2] - corners[0]));
  if (hull.count == 3) offer(cross(p[1] - p[0], p[2] - p[0]));
  const std::size_t edges = hull.count == 3 ? 3 : 1;
  for (std::size_t i = 0; i < edges; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      offer(cross(p[(i + 1) % hull.count] - p[i], corners[(j + 1) % 3] - corners[j]));
    }
  }
  return best;
}

/// Below this share of the size, the difference of the closest points is too noisy a direction.
inline constexpr double kNoisyDirection = 1e-6;

/// The plane normal to the direction of the closest points is nearly the best one; if they are too
/// close, the planes of the features are.
template <typename S, typename Other>
Certificate<S> certify(const HullView<S>& hull, const Other& other) {
  const Closest<S> closest = closestPoints(hull, other);
  Certificate<S> c{closest.distance, closest.distance - (hull.stray + strayOf(other))};
  if (!(closest.distance > 0)) return c;
  const Vec3<S> n = S(1 / closest.distance) * (closest.onSegment - closest.onTriangle);
  c.least = std::max(c.least, clearanceAlong(n, hull, other));
  S size = 0;
  for (const Vec3<S>& corner : cornersOn(other)) size = std::max(size, extent(corner));
  if (closest.distance < S(kNoisyDirection) * size) {
    c.least = std::max(c.least, clearanceAlongFeatures(hull, other));
  }
  return c;
}

/// One look at a hull: relative to a nearby point, in double for the quick answer and in long
/// double for the decision.
struct HullLook {
  Vec3d reference;
  HullView<Real> exact;
  HullView<double> quick;
};
HullLook hullLook(const MovingPoint* points, std::size_t count, Real halfSpan);
HullLook hullLook(const MovingPoint* points, std::size_t count, Real halfSpan,
                  const Vec3d& reference);

/// How much a distance in double may err, as a share of the coordinates' differences: some forty
/// operations of 2^-53 each, taken fifty times over.
inline constexpr double kDoubleMargin = 1e-12;

enum class HullCheck {
  Free,      ///< Separation > -guard throughout the look's span.
  Touching,  ///< Separation < -guard at its middle, or the hull itself pierced.
  Open,      ///< Neither is shown.
};
/// Hull with a radius against a triangle; `separation` is set where touching.
HullCheck checkHull(const HullLook& look, Real radius, Real guard, const Triangle& triangle,
                    Real& separation);
/// Against another that moves, relative to the same point; `radius` is the sum of both.
HullCheck checkHull(const HullLook& look, Real radius, Real guard, const HullLook& other,
                    Real& separation);

}  // namespace foretouch::oracle
