#include "judge/cast_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "judge/distance.h"

namespace foretouch::oracle {
namespace {

/// The golden section leaves 0.618^110 = 1e-23 of a way; halves as many.
constexpr int kSections = 110;
constexpr int kHalvings = 80;
/// For hulls, which take longer: 0.618^60 = 3e-13.
constexpr int kSectionsOfHull = 60;
/// Doubles show that things are apart only if they are by so much (m), and by so much of all
/// lengths.
constexpr double kClearly = 1e-9, kClearShare = 1e-13;
constexpr int kSteps = 24;

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

Real determinant(const Vec3r& a, const Vec3r& b, const Vec3r& c, const Vec3r& d) {
  return dot(cross(b - a, c - a), d - a);
}

Closest<Real> closestOfAxis(const Vec3r& a, const Vec3r& b, const OraclePart& part) {
  const Corners<Real> corners = cornersOf(part);
  if (part.count == 3) return closestPoints(a, b, corners);
  return closestPoints(Corners<Real>{a, b, b}, corners);
}

Real radiiOf(const CastShape& shape, const OraclePart& part) {
  return static_cast<Real>(shape.radius) + static_cast<Real>(part.radius);
}

/// Where all corners are, of the shape as it begins and of the part: they stand for the cores.
template <typename S>
struct Cores {
  std::vector<Vec3<S>> shape, part;
  Vec3<S> way;

  /// The lowest point, along a direction, of the difference of all of the way and the part.
  [[nodiscard]] Vec3<S> lowest(const Vec3<S>& along) const {
    const auto isLess = [&](const Vec3<S>& x, const Vec3<S>& y) {
      return dot(along, x) < dot(along, y);
    };
    Vec3<S> low = *std::min_element(shape.begin(), shape.end(), isLess);
    if (dot(along, way) < 0) low = low + way;
    return low - *std::max_element(part.begin(), part.end(), isLess);
  }
};

template <typename S>
Cores<S> coresOf(const CastShape& shape, Real until, const OraclePart& part) {
  Cores<S> cores;
  cores.way = (until * unitOf(shape.direction)).as<S>();
  if (shape.corners.empty()) cores.shape = {shape.a.as<S>(), shape.b.as<S>()};
  for (const Vec3d& corner : shape.corners) {
    cores.shape.push_back(shape.a.as<S>() + corner.as<S>());
  }
  for (const Vec3r& corner : cornersOf(part)) cores.part.push_back(corner.as<S>());
  return cores;
}

/// Is there a plane between all of the way and the part that parts them by clearly more than this?
/// Looked for in doubles, by triangles of points of their difference, nearer and nearer to the
/// origin [Gilbert88]: a plane that is found is one, however it was.
bool areClearlyApart(const Cores<double>& cores, Real by) {
  double lengths = extent(cores.way);
  for (const Vec3d& p : cores.shape) lengths = std::max(lengths, extent(p));
  for (const Vec3d& p : cores.part) lengths = std::max(lengths, extent(p));
  const double apart = static_cast<double>(by) + kClearly + kClearShare * lengths;
  const Vec3d origin, first = cores.shape.front() - cores.part.front();
  Triangle points{first, first, first};
  Closest<double> nearest = closestPoints(origin, origin, points);
  for (int i = 0; i < kSteps && nearest.distance > apart; ++i) {
    const Vec3d lowest = cores.lowest(nearest.onTriangle);
    if (dot(nearest.onTriangle, lowest) > apart * nearest.distance) return true;
    const Triangle before = points;
    for (std::size_t k = 0; k < 3; ++k) {
      Triangle with = before;
      with[k] = lowest;
      const Closest<double> one = closestPoints(origin, origin, with);
      if (one.distance >= nearest.distance) continue;
      nearest = one;
      points = with;
    }
    if (points == before) return false;
  }
  return false;
}

Triangle roughly(const Corners<Real>& corners) {
  return {corners[0].as<double>(), corners[1].as<double>(), corners[2].as<double>()};
}

/// The closest points of the part and the hull of corners at a place; 0 inside.
Closest<Real> closestOfHull(const CastShape& shape, const Vec3r& place, const OraclePart& part) {
  Corners<Real> corners = cornersOf(part);
  for (Vec3r& corner : corners) corner = corner - place;
  if (!areClearlyApart({shape.corners, {corners[0].as<double>()}, {}}, 0)) {
    for (const auto& tetrahedron : shape.tetrahedra) {
      if (isIn(corners[0], tetrahedron)) return {};
    }
  }
  // In doubles first: only what may be the nearest counts.
  const Triangle rough = roughly(corners);
  std::vector<double> gaps;
  double lengths = extent(rough[0]);
  for (const Corners<Real>& face : shape.outer) {
    gaps.push_back(closestPoints(roughly(face), rough).distance);
    lengths = std::max(lengths, extent(face[0].as<double>()));
  }
  const double nearest =
      *std::min_element(gaps.begin(), gaps.end()) + kClearly + kClearShare * lengths;
  Closest<Real> least{std::numeric_limits<Real>::infinity(), {}, {}};
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] > nearest) continue;
    const Closest<Real> one = closestPoints(shape.outer[i], corners);
    if (one.distance < least.distance) least = one;
  }
  return least;
}

/// The closest points of the cores, after it has moved so far; both from the hull's place, if it
/// is one.
Closest<Real> closestAfter(const CastShape& shape, Real along, const OraclePart& part) {
  const Vec3r moved = along * unitOf(shape.direction);
  if (!shape.corners.empty()) return closestOfHull(shape, shape.a.as<Real>() + moved, part);
  return closestOfAxis(shape.a.as<Real>() + moved, shape.b.as<Real>() + moved, part);
}

/// All along the way it is no nearer than the plane across the closest points at its end says.
Real boundFromEnd(const CastShape& shape, Real until, const OraclePart& part) {
  const Closest<Real> end = closestAfter(shape, until, part);
  if (!(end.distance > 0)) return -radiiOf(shape, part);
  const Vec3r normal = (1 / end.distance) * (end.onSegment - end.onTriangle);
  return dot(normal, coresOf<Real>(shape, until, part).lowest(normal)) - radiiOf(shape, part);
}

/// The gap from a ball around the part to the line that a ball around the shape moves along.
Real gapOfBalls(const CastShape& shape, const Vec3r& way, Real until, const OraclePart& part) {
  const Vec3r a = shape.a.as<Real>(), b = shape.b.as<Real>();
  const Vec3r middle = Real(0.5) * (a + b);
  const Corners<Real> corners = cornersOf(part);
  const Vec3r centre = (Real(1) / 3) * (corners[0] + corners[1] + corners[2]);
  Real radius = 0, ofHull = 0;
  for (const Vec3r& corner : corners) radius = std::max(radius, norm(corner - centre));
  for (const Vec3d& corner : shape.corners) ofHull = std::max(ofHull, norm(corner.as<Real>()));
  const Real between = pointSegmentDistance(centre, middle, middle + until * way);
  return between - radius - norm(a - middle) - ofHull - radiiOf(shape, part);
}

struct Least {
  Real gap, along;
};

}  // namespace

Real gapAfter(const CastShape& shape, Real along, const OraclePart& part) {
  return closestAfter(shape, along, part).distance - radiiOf(shape, part);
}

namespace {

Least leastOf(const CastShape& shape, Real until, const OraclePart& part) {
  const Real golden = (std::sqrt(Real(5)) - 1) / 2;
  Least least{gapAfter(shape, 0, part), 0};
  if (until == 0) return least;
  const auto look = [&](Real along) {
    const Real gap = gapAfter(shape, along, part);
    if (gap < least.gap) least = {gap, along};
    return gap;
  };
  look(until);
  Real low = 0, high = until;
  Real left = high - golden * (high - low), right = low + golden * (high - low);
  Real atLeft = look(left), atRight = look(right);
  const int sections = shape.corners.empty() ? kSections : kSectionsOfHull;
  for (int i = 0; i < sections && low < high; ++i) {
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
  if (areClearlyApart(coresOf<double>(shape, until, part), beyond + radiiOf(shape, part))) {
    return beyond + static_cast<Real>(kClearly);
  }
  const Real bound = until > 0 ? boundFromEnd(shape, until, part) : beyond;
  if (bound > beyond + 1e-14L) return bound;
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

bool isClearlyOutside(const Vec3d& p, const std::vector<Vec3d>& corners) {
  return areClearlyApart({corners, {p}, {}}, 0);
}

bool isIn(const Vec3r& p, const std::array<Vec3r, 4>& t) {
  const Real whole = determinant(t[0], t[1], t[2], t[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Vec3r, 4> with = t;
    with[i] = p;
    if (whole * determinant(with[0], with[1], with[2], with[3]) < 0) return false;
  }
  return whole != 0;
}

void CastShape::setHull(const std::vector<Vec3d>& given, Real scale) {
  corners = given;
  outer.clear();
  tetrahedra.clear();
  const std::size_t count = given.size();
  Vec3r middle;
  for (const Vec3d& corner : given) middle = middle + (Real(1) / count) * corner.as<Real>();
  std::vector<Vec3r> at;
  for (const Vec3d& corner : given) at.push_back(middle + scale * (corner.as<Real>() - middle));
  Real size = 0;
  for (const Vec3r& corner : at) size = std::max(size, norm(corner - middle));
  const Real noise = 1e-16L * size * size * size;
  // A triangle that other corners are clearly on both sides of is inside.
  const auto isOuter = [&](std::size_t i, std::size_t j, std::size_t k) {
    Real least = 0, most = 0;
    for (const Vec3r& other : at) {
      const Real volume = determinant(at[i], at[j], at[k], other);
      least = std::min(least, volume);
      most = std::max(most, volume);
    }
    return std::min(-least, most) <= 1e-12L * std::max(-least, most) + noise;
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i; j < count; ++j) {
      for (std::size_t k = j; k < count; ++k) {
        if (count > 2 && (i == j || j == k)) continue;
        if (isOuter(i, j, k)) outer.push_back({at[i], at[j], at[k]});
        for (std::size_t l = k + 1; l < count; ++l) {
          tetrahedra.push_back({at[i], at[j], at[k], at[l]});
        }
      }
    }
  }
}

bool surelyCrosses(const CastShape& shape, Real until, const OraclePart& part, Real margin) {
  const Vec3r way = unitOf(shape.direction), from = shape.a.as<Real>();
  const Corners<Real> v = cornersOf(part);
  Vec3r normal = cross(v[1] - v[0], v[2] - v[0]);
  const Real size = norm(normal);
  if (size == 0) return false;
  normal = (1 / size) * normal;
  const Real pace = dot(normal, way);
  if (std::abs(pace) < 1e-2L) return false;
  const Real along = dot(normal, v[0] - from) / pace;
  if (!(along > margin && along < until - margin)) return false;
  const Vec3r p = from + along * way;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3r edge = v[(i + 1) % 3] - v[i];
    const Real length = norm(edge);
    if (length == 0 || dot(cross(edge, p - v[i]), normal) < margin * length) return false;
  }
  return true;
}

bool isInside(const Vec3r& p, const std::vector<Corners<Real>>& surface) {
  // Directions in no special place: the cosines of whole numbers.
  for (int attempt = 1;; ++attempt) {
    const Vec3r way{std::cos(Real(attempt)), std::cos(Real(2 * attempt + 1)),
                    std::cos(Real(3 * attempt + 2))};
    int crossings = 0;
    bool isClear = true;
    for (const Corners<Real>& v : surface) {
      const Real whole = dot(way, cross(v[1] - v[0], v[2] - v[0]));
      std::array<Real, 3> shares;
      for (std::size_t i = 0; i < 3; ++i) {
        shares[i] = dot(way, cross(v[i] - p, v[(i + 1) % 3] - p)) / whole;
      }
      const Real least = std::min({shares[0], shares[1], shares[2]});
      const Real along = dot(v[0] - p, cross(v[1] - v[0], v[2] - v[0])) / whole;
      // A sliver's shares are noise: another direction may not be; in the end it decides.
      isClear = isClear && (std::abs(least) > 1e-9L || attempt > 50);
      if (least > 0 && along > 0) ++crossings;
    }
    if (isClear) return crossings % 2 != 0;
  }
}

Real heightOver(const Vec3d& p, const OraclePart& part) {
  return closestOfAxis(p.as<Real>(), p.as<Real>(), part).distance - static_cast<Real>(part.radius);
}

}  // namespace foretouch::oracle
