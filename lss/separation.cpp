#include "lss/separation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// Absorbs what underflow may lose (m): squares of lengths below about 1e-154 vanish entirely.
constexpr double kUnderflow = 1e-150;
/// Shrinks a computed unit vector so that its true norm is at most 1 (normalising errs by 4 u).
constexpr double kUnitShrink = 1.0 - 0x1p-50;
/// Where the closest points are nearer than this fraction of the pair's extent, their difference is
/// a noisy direction and the features' own normal is tried as well.
constexpr double kNoisyDirection = 1e-3;

/// The pair, relative to the triangle's first vertex.
struct LocalPair {
  Vector3d a, b, e1, e2;
  double slack;  // kSeparationRounding times the extents, by 1-norms (never below the 2-norms)
};

void tryDirection(const LocalPair& pair, const Vector3d& direction, Separation& best) {
  const double norm = direction.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return;
  const Vector3d nhat = (kUnitShrink / norm) * direction;
  const double top = std::max(0.0, std::max(nhat.dot(pair.e1), nhat.dot(pair.e2)));
  const double clearanceA = nhat.dot(pair.a) - top - pair.slack;
  const double clearanceB = nhat.dot(pair.b) - top - pair.slack;
  if (std::min(clearanceA, clearanceB) > best.lower()) {
    best.nhat = nhat;
    best.clearanceA = clearanceA;
    best.clearanceB = clearanceB;
  }
}

}  // namespace

Separation separation(const Vector3d& a, const Vector3d& b, const Triangle& triangle) {
  const Vector3d& origin = triangle.vertices[0];
  LocalPair pair{a - origin, b - origin, triangle.vertices[1] - origin,
                 triangle.vertices[2] - origin, 0.0};
  const double extent =
      pair.a.lpNorm<1>() + pair.b.lpNorm<1>() + pair.e1.lpNorm<1>() + pair.e2.lpNorm<1>();
  pair.slack = kSeparationRounding * extent + kUnderflow;

  Separation result;
  result.closest = closestPoints(a, b, triangle);
  result.upper = result.closest.distance + pair.slack;
  // Without a direction the trivial bound stands: a distance is not below zero, and nhat = 0 proves
  // it.
  result.clearanceA = result.clearanceB = -pair.slack;
  tryDirection(pair, result.closest.difference, result);
  if (result.closest.distance < kNoisyDirection * extent) {
    tryDirection(pair, result.closest.featureNormal, result);
    tryDirection(pair, -result.closest.featureNormal, result);
  }
  return result;
}

}  // namespace foretouch
