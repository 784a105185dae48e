#include "judge/depth_oracle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "judge/distance.h"

namespace foretouch::oracle {
namespace {

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// The piece's corners; a segment as a triangle of no area.
Corners<Real> cornersOf(const DepthPiece& piece, const Vec3d& move) {
  Corners<Real> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t own = std::min(i, static_cast<std::size_t>(piece.count) - 1);
    corners[i] = piece.corners[own].as<Real>() + move.as<Real>();
  }
  return corners;
}

}  // namespace

std::vector<Vec3r> evenDirections(int count) {
  const Real golden = 3.14159265358979323846L * (3.0L - std::sqrt(5.0L));
  std::vector<Vec3r> directions;
  for (int i = 0; i < count; ++i) {
    const Real z = 1.0L - (2.0L * static_cast<Real>(i) + 1.0L) / static_cast<Real>(count);
    const Real across = std::sqrt(1.0L - z * z), angle = golden * static_cast<Real>(i);
    directions.emplace_back(across * std::cos(angle), across * std::sin(angle), z);
  }
  return directions;
}

Real leastToPart(const DepthPiece& one, const DepthPiece& other, const std::vector<Vec3r>& along) {
  const Corners<Real> x = cornersOf(one, {}), y = cornersOf(other, {});
  Real least = kInfinity;
  for (const Vec3r& n : along) {
    const Real lowest = std::min({dot(n, x[0]), dot(n, x[1]), dot(n, x[2])});
    const Real highest = std::max({dot(n, y[0]), dot(n, y[1]), dot(n, y[2])});
    least = std::min(least, highest - lowest);
  }
  return least + one.radius + other.radius;
}

Real separationAfter(const DepthPiece& one, const Vec3d& move, const DepthPiece& other) {
  const Corners<Real> x = cornersOf(one, move), y = cornersOf(other, {});
  const Real distance = one.count == 2 ? closestPoints<Real>(x[0], x[1], y).distance
                                       : closestPoints<Real>(x, y).distance;
  return distance - static_cast<Real>(one.radius) - static_cast<Real>(other.radius);
}

Real separationAfter(const std::vector<DepthPiece>& moved, const Vec3d& move,
                     const std::vector<DepthPiece>& others) {
  Real least = kInfinity;
  for (const DepthPiece& one : moved) {
    for (const DepthPiece& other : others) {
      least = std::min(least, separationAfter(one, move, other));
    }
  }
  return least;
}

}  // namespace foretouch::oracle
