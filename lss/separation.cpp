#include "lss/separation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// The pair, relative to the triangle's first vertex.
struct LocalPair {
  Vector3d a, b, e1, e2;
  double slack;  // kSeparationRounding times the extents, by 1-norms (never below the 2-norms)
};

void tryDirection(const LocalPair& pair, const Vector3d& direction, Separation& best) {
  const double norm = direction.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return;
  const Vector3d nhat = (internal::kUnitShrink / norm) * direction;
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
  pair.slack = kSeparationRounding * extent + internal::kUnderflow;

  Separation result;
  result.closest = closestPoints(a, b, triangle);
  result.upper = result.closest.distance + pair.slack;
  // Without a direction the trivial bound holds: a distance is not below zero, and nhat = 0 proves
  // it.
  result.clearanceA = result.clearanceB = -pair.slack;
  tryDirection(pair, result.closest.difference, result);
  if (result.closest.distance < internal::kNoisyDirection * extent) {
    tryDirection(pair, result.closest.featureNormal, result);
    tryDirection(pair, -result.closest.featureNormal, result);
  }
  return result;
}

}  // namespace foretouch
