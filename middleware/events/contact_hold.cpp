#include "middleware/events/contact_hold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "lss/closest_features.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Roundings of a weighted point, of the difference of two, and of the norm, relative to the
/// coordinates involved.
constexpr double kPointRounding = 32.0 * kUnitRoundoff;
/// The rounding of a determinant of three differences, relative to the product of their lengths.
constexpr double kDeterminantRounding = 64.0 * kUnitRoundoff;
/// A step is found to this share of what it could be.
constexpr double kStepShare = 0.01;
constexpr int kMostRounds = 24;
/// A weighted point that is farther from the one that is meant is not taken, relative to the edges.
constexpr double kMostOff = 1e-10;

/// A point that moves with a part.
struct HeldPoint {
  Vector3d place, velocity;
  double acceleration = 0.0, positionRounding = 0.0, velocityRounding = 0.0;
};

/// The weights for a triangle that is all but a segment, whose face says nothing.
std::array<double, 2> weightsOnEdges(const Vector3d& u, const Vector3d& v, const Vector3d& q) {
  const auto along = [](const Vector3d& edge, const Vector3d& from) {
    const double length = edge.squaredNorm();
    return length > 0.0 ? clamp01(from.dot(edge) / length) : 0.0;
  };
  const double ofThird = along(v - u, q - u);
  const std::array<std::array<double, 2>, 3> all = {
      {{along(u, q), 0.0}, {0.0, along(v, q)}, {1.0 - ofThird, ofThird}}};
  const auto off = [&](const std::array<double, 2>& w) {
    return (w[0] * u + w[1] * v - q).squaredNorm();
  };
  return *std::min_element(all.begin(), all.end(),
                           [&](const auto& x, const auto& y) { return off(x) < off(y); });
}

/// The weights of a point of the hull near `p`: all at least 0, their sum at most 1 up to rounding;
/// the first point has the rest.
std::array<double, 2> weightsAt(const Hull& hull, const Vector3d& p) {
  const Vector3d u = hull.points[1] - hull.points[0], q = p - hull.points[0];
  if (hull.count == 2) {
    const double uu = u.squaredNorm();
    return {uu > 0.0 ? clamp01(q.dot(u) / uu) : 0.0, 0.0};
  }
  const Vector3d v = hull.points[2] - hull.points[0], n = u.cross(v);
  const double nn = n.squaredNorm();
  double b = 0.0, c = 0.0;
  if (nn > 0.0) {
    b = clamp01(q.cross(v).dot(n) / nn);
    c = clamp01(u.cross(q).dot(n) / nn);
  } else if (u.squaredNorm() > 0.0) {
    b = clamp01(q.dot(u) / u.squaredNorm());
  }
  const double sum = b + c;
  if (sum > 1.0) {
    b /= sum;
    c /= sum;
  }
  const double off = (b * u + c * v - q).squaredNorm();
  const double most = kMostOff * (u.lpNorm<1>() + v.lpNorm<1>());
  return off > most * most ? weightsOnEdges(u, v, q) : std::array<double, 2>{b, c};
}

HeldPoint heldPoint(const MovingHull& part, const Vector3d& p) {
  const auto& x = part.hull.points;
  const std::array<double, 2> w = weightsAt(part.hull, p);
  HeldPoint point;
  const Vector3d u = x[1] - x[0];
  point.place = x[0] + w[0] * u;
  double extent = x[0].lpNorm<1>() + u.lpNorm<1>();
  if (part.hull.count == 3) {
    const Vector3d v = x[2] - x[0];
    point.place += w[1] * v;
    extent += v.lpNorm<1>();
  }
  point.positionRounding = kPointRounding * extent;
  point.velocity = Vector3d::Zero();
  if (!part.moves) return point;
  point.velocity = part.velocity[0] + w[0] * (part.velocity[1] - part.velocity[0]);
  double speeds = part.velocity[0].lpNorm<1>() + part.velocity[1].lpNorm<1>();
  const std::size_t count = countOf(part.hull.count);
  if (count == 3) {
    point.velocity += w[1] * (part.velocity[2] - part.velocity[0]);
    speeds += part.velocity[2].lpNorm<1>();
  }
  const auto most = [count](const std::array<double, 3>& of) {
    return count == 3 ? std::max({of[0], of[1], of[2]}) : std::max(of[0], of[1]);
  };
  point.acceleration = most(part.acceleration);
  point.positionRounding += most(part.positionRounding);
  point.velocityRounding = most(part.velocityRounding) + kPointRounding * speeds;
  return point;
}

/// What two points leave of `reach`, at least, after a time: concave in it.
struct Slack {
  Vector3d apart, drift;
  double reach, acceleration, driftRounding;

  [[nodiscard]] double at(double s) const {
    const Vector3d then = apart + s * drift;
    const double bend = 0.5 * acceleration * s * s, off = driftRounding * s;
    const double sums = reach + apart.lpNorm<1>() + s * drift.lpNorm<1>() + bend + off;
    return reach - then.norm() - bend - off - kPointRounding * sums;
  }
};

/// Where a concave function that is not below zero at 0 is not below zero, up to `rest`: chords
/// between where it is and where it is not lie below it.
template <typename Concave>
double lastNotBelow(const Concave& f, double rest) {
  double low = 0.0, atLow = f(0.0), high = rest, atHigh = f(rest);
  if (!(atLow >= 0.0)) return 0.0;
  if (atHigh >= 0.0) return rest;
  for (int round = 0; round < kMostRounds && high - low > kStepShare * high; ++round) {
    // The chord's root from below; the middle, a little of it, so that both ends move.
    const double chord = low + (high - low) * (atLow / (atLow - atHigh));
    const double middle = 0.5 * (low + high);
    for (const double s : {chord, middle}) {
      if (!(s > low && s < high)) continue;
      const double at = f(s);
      if (at >= 0.0) {
        low = s;
        atLow = at;
      } else {
        high = s;
        atHigh = at;
      }
    }
  }
  return low;
}

double determinant(const Vector3d& u, const Vector3d& v, const Vector3d& w) {
  return u.cross(v).dot(w);
}

/// One of the functions that keep their signs while a segment goes through a triangle: the
/// determinant of three differences, each of which changes by no more than its bound.
struct Orientation {
  double size = 0.0;              // that of its value, rounding taken off
  std::array<double, 3> lengths;  // of the differences
  std::array<double, 3> areas;    // of the other two
  double spread = 0.0;

  Orientation(const Vector3d& u, const Vector3d& v, const Vector3d& w, bool isPositive,
              double rounding) {
    const double value = determinant(u, v, w);
    lengths = {u.norm() * kInflation, v.norm() * kInflation, w.norm() * kInflation};
    const double slack = kDeterminantRounding * lengths[0] * lengths[1] * lengths[2];
    areas = {v.cross(w).norm() + kDeterminantRounding * lengths[1] * lengths[2],
             u.cross(w).norm() + kDeterminantRounding * lengths[0] * lengths[2],
             u.cross(v).norm() + kDeterminantRounding * lengths[0] * lengths[1]};
    spread = 2.0 * rounding;
    size = (isPositive ? value : -value) - slack;
  }
  /// What is left if each difference has changed by `by`.
  [[nodiscard]] double leaves(double by) const {
    const double d = by + spread;
    const double change = d * (areas[0] + areas[1] + areas[2]) +
                          d * d * (lengths[0] + lengths[1] + lengths[2]) + d * d * d;
    return size - change * kInflation;
  }
};

/// How far points move at most, apart from a common motion, in a time.
struct Travel {
  double speed = 0.0, acceleration = 0.0;

  void add(const MovingHull& part, std::size_t i, const Vector3d& common) {
    const double own =
        part.moves ? (part.velocity[i] - common).norm() + part.velocityRounding[i] : common.norm();
    speed = std::max(speed, own * kInflation);
    if (part.moves) acceleration = std::max(acceleration, part.acceleration[i]);
  }
  [[nodiscard]] double in(double s) const {
    return (speed * s + 0.5 * acceleration * s * s) * kInflation;
  }
};

/// The edge from point `a` to point `b` of `edged`, through `triangle`.
double edgeStays(const MovingHull& edged, std::size_t a, std::size_t b, const MovingHull& triangle,
                 double rest) {
  const Vector3d &p = edged.hull.points[a], &q = edged.hull.points[b];
  const auto& v = triangle.hull.points;
  double rounding = 0.0, extent = p.lpNorm<1>() + q.lpNorm<1>();
  for (std::size_t i = 0; i < 3; ++i) {
    extent += v[i].lpNorm<1>();
    if (triangle.moves) rounding = std::max(rounding, triangle.positionRounding[i]);
  }
  if (edged.moves) {
    rounding += std::max(edged.positionRounding[a], edged.positionRounding[b]);
  }
  rounding += kPointRounding * extent;
  const Vector3d e1 = v[1] - v[0], e2 = v[2] - v[0], axis = q - p;
  const bool isAbove = determinant(e1, e2, p - v[0]) > 0.0;
  // Seen from the side of p, the corners go round the edge in one direction.
  const std::array<Orientation, 5> functions = {
      Orientation(e1, e2, p - v[0], isAbove, rounding),
      Orientation(e1, e2, q - v[0], !isAbove, rounding),
      Orientation(axis, v[0] - p, v[1] - p, !isAbove, rounding),
      Orientation(axis, v[1] - p, v[2] - p, !isAbove, rounding),
      Orientation(axis, v[2] - p, v[0] - p, !isAbove, rounding)};
  Vector3d common = Vector3d::Zero();
  if (triangle.moves && edged.moves) {
    common = (triangle.velocity[0] + triangle.velocity[1] + triangle.velocity[2]) / 3.0;
  }
  Travel ofEdge, ofTriangle;
  ofEdge.add(edged, a, common);
  ofEdge.add(edged, b, common);
  for (std::size_t i = 0; i < 3; ++i) ofTriangle.add(triangle, i, common);
  const auto least = [&](double s) {
    // A difference is one of two points of the edge, of the triangle, or of one of each.
    const double own = ofEdge.in(s), its = ofTriangle.in(s);
    const double by = 2.0 * std::max(own, its);
    double left = functions[0].leaves(by);
    for (const Orientation& f : functions) left = std::min(left, f.leaves(by));
    return left;
  };
  // Falls with time: not concave, so halves decide.
  if (!(least(0.0) > 0.0)) return 0.0;
  if (least(rest) > 0.0) return rest;
  double low = 0.0, high = rest;
  for (int round = 0; round < kMostRounds && high - low > kStepShare * high; ++round) {
    const double middle = 0.5 * (low + high);
    (least(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

double staysWithin(const MovingPair& pair, double limit, double rest) {
  const HeldPoint x = heldPoint(pair.one, pair.axes.onOne),
                  y = heldPoint(pair.other, pair.axes.onOther);
  const Slack slack{
      x.place - y.place, x.velocity - y.velocity,
      (pair.one.radius + pair.other.radius + limit) - (x.positionRounding + y.positionRounding),
      (x.acceleration + y.acceleration) * kInflation, x.velocityRounding + y.velocityRounding};
  return lastNotBelow([&](double s) { return slack.at(s); }, rest);
}

double staysPierced(const MovingPair& pair, double rest) {
  const MovingHull &one = pair.one, &other = pair.other;
  double longest = 0.0;
  const auto tryEdges = [&](const MovingHull& edged, const MovingHull& triangle) {
    if (triangle.hull.count != 3) return;
    const std::size_t edges = edged.hull.count == 3 ? 3 : 1;
    for (std::size_t i = 0; i < edges; ++i) {
      longest = std::max(longest, edgeStays(edged, i, (i + 1) % 3, triangle, rest));
    }
  };
  tryEdges(one, other);
  tryEdges(other, one);
  return longest;
}

}  // namespace foretouch::internal
