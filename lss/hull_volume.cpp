#include "lss/hull_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>

namespace foretouch {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using HullFace = std::array<std::size_t, 3>;  // counter-clockwise from outside

/// A share of the cloud's size, cubed: a flatter cloud counts as flat, because rounding alone could
/// make it so.
constexpr double kFlat = 1e-13;

constexpr int kDirectionPairs = 110;  // and the three axes

/// Points of a spiral over the half sphere, evenly spread: equal steps in height and the golden
/// angle in azimuth.
std::vector<Vector3d> spiralDirections() {
  std::vector<Vector3d> directions = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  constexpr double kGoldenAngle = 2.39996322972865332;
  for (int i = 0; i < kDirectionPairs; ++i) {
    const double z = (i + 0.5) / kDirectionPairs;
    const double across = std::sqrt(1.0 - z * z);
    const double azimuth = kGoldenAngle * i;
    directions.emplace_back(across * std::cos(azimuth), across * std::sin(azimuth), z);
  }
  return directions;
}

/// Six times the signed volume of a tetrahedron; positive if `p` sees the face from outside.
double sixVolumes(const Points& points, const HullFace& face, const Vector3d& p) {
  const Vector3d& a = points[face[0]];
  return (points[face[1]] - a).cross(points[face[2]] - a).dot(p - a);
}

template <typename Measure>
std::size_t largestBy(const Points& points, const Measure& measure) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const double m = measure(points[i]); m > most) {
      most = m;
      best = i;
    }
  }
  return best;
}

/// The faces of a first tetrahedron, as large as a few sweeps find.
std::vector<HullFace> firstFaces(const Points& points) {
  const auto from = [&](std::size_t i) {
    return [&, i](const Vector3d& p) { return (p - points[i]).squaredNorm(); };
  };
  const std::size_t a = largestBy(points, from(0));
  const std::size_t b = largestBy(points, from(a));
  const Vector3d ab = points[b] - points[a];
  const std::size_t c =
      largestBy(points, [&](const Vector3d& p) { return ab.cross(p - points[a]).squaredNorm(); });
  const HullFace base{a, b, c};
  const std::size_t d =
      largestBy(points, [&](const Vector3d& p) { return std::abs(sixVolumes(points, base, p)); });
  if (sixVolumes(points, base, points[d]) > 0.0)
    return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
  return {base, {b, a, d}, {c, b, d}, {a, c, d}};
}

/// Replaces the faces that `top` sees by a cone from it; returns six times the added volume.
double addPoint(const Points& points, std::size_t top, double flat, std::vector<HullFace>& faces) {
  double added = 0.0;
  std::set<std::pair<std::size_t, std::size_t>> edges;
  std::vector<HullFace> kept;
  for (const HullFace& face : faces) {
    const double volume = sixVolumes(points, face, points[top]);
    if (!(volume > flat)) {
      kept.push_back(face);
      continue;
    }
    added += volume;
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(face[k], face[(k + 1) % 3]);
  }
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) == 0) kept.push_back({from, to, top});  // the horizon
  }
  faces = std::move(kept);
  return added;
}

}  // namespace

Points extremePoints(const Points& points) {
  static const std::vector<Vector3d> directions = spiralDirections();
  if (points.size() <= 2 * directions.size()) return points;
  std::vector<std::size_t> chosen;
  for (const Vector3d& direction : directions) {
    std::size_t low = 0, high = 0;
    double least = direction.dot(points[0]), most = least;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double reach = direction.dot(points[i]);
      if (reach < least) least = reach, low = i;
      if (reach > most) most = reach, high = i;
    }
    chosen.insert(chosen.end(), {low, high});
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  Points extremes;
  for (const std::size_t i : chosen) extremes.push_back(points[i]);
  return extremes;
}

double hullVolume(const Points& all) {
  if (all.size() < 4) return 0.0;
  const Points points = extremePoints(all);
  double size = 0.0;
  for (const Vector3d& p : points) size = std::max(size, (p - points[0]).norm());
  const double flat = kFlat * size * size * size;
  std::vector<HullFace> faces = firstFaces(points);
  double six = -sixVolumes(points, faces[0], points[faces[1][2]]);
  if (!(six > flat)) return 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) six += addPoint(points, i, flat, faces);
  return six / 6.0;
}

}  // namespace foretouch
