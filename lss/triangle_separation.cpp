#include "lss/triangle_separation.h"

#include <cmath>

#include "lss/closest_features.h"
#include "lss/separation.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Closest;
using internal::Edge;
using internal::Face;

/// Both triangles relative to the other's first vertex.
struct LocalTriangles {
  std::array<Vector3d, 3> one, other;  // other[0] = 0
  double slack;                        // rounding of the bounds (lss/separation.cpp)
};

std::array<Edge, 3> edgesOf(const std::array<Vector3d, 3>& v) {
  return {Edge(v[0], v[1] - v[0]), Edge(v[1], v[2] - v[1]), Edge(v[2], v[0] - v[2])};
}

/// Corners and edges of `points` against a face: corners that project into it, edges that pierce
/// it. `offer` takes the point and its counterpart on the face.
template <typename Offer>
void forFace(const std::array<Vector3d, 3>& points, const Face& face, const Offer& offer) {
  if (!face.hasArea()) return;  // its edges are the whole triangle
  std::array<double, 3> height;
  for (std::size_t i = 0; i < 3; ++i) height[i] = face.height(points[i]);
  Vector3d onFace;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (face.project(points[i], onFace)) offer(points[i], onFace);
    if (!Face::crosses(height[i], height[next])) continue;
    const double s = internal::clamp01(height[i] / (height[i] - height[next]));
    const Vector3d piercing = points[i] + s * (points[next] - points[i]);
    if (face.project(piercing, onFace)) offer(piercing, onFace);
  }
}

Closest closestOf(const LocalTriangles& local) {
  Closest best;
  const Face faceOne(local.one[0], local.one[1] - local.one[0], local.one[2] - local.one[0]);
  const Face faceOther(local.other[0], local.other[1], local.other[2]);
  forFace(local.one, faceOther, [&](const Vector3d& p, const Vector3d& onFace) {
    best.offer(p, onFace, faceOther.normal);
  });
  forFace(local.other, faceOne, [&](const Vector3d& p, const Vector3d& onFace) {
    best.offer(onFace, p, faceOne.normal);
  });
  const auto edgesOther = edgesOf(local.other);
  for (const Edge& edge : edgesOf(local.one)) {
    for (const Edge& other : edgesOther) offerEdges(edge, other, best);
  }
  return best;
}

void tryDirection(const LocalTriangles& local, const Vector3d& direction,
                  TriangleSeparation& best) {
  const double norm = direction.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return;
  const Vector3d nhat = (internal::kUnitShrink / norm) * direction;
  const double top = std::max(0.0, std::max(nhat.dot(local.other[1]), nhat.dot(local.other[2])));
  std::array<double, 3> clearance;
  for (std::size_t i = 0; i < 3; ++i) clearance[i] = nhat.dot(local.one[i]) - top - local.slack;
  if (*std::min_element(clearance.begin(), clearance.end()) > best.lower()) {
    best.nhat = nhat;
    best.clearance = clearance;
  }
}

}  // namespace

TriangleSeparation triangleSeparation(const Triangle& one, const Triangle& other) {
  const Vector3d& origin = other.vertices[0];
  LocalTriangles local{};
  double extent = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    local.one[i] = one.vertices[i] - origin;
    local.other[i] = other.vertices[i] - origin;
    extent += local.one[i].lpNorm<1>() + local.other[i].lpNorm<1>();
  }
  local.slack = kSeparationRounding * extent + internal::kUnderflow;

  const Closest closest = closestOf(local);
  TriangleSeparation result;
  result.onOne = origin + closest.onOne;
  result.onOther = origin + closest.onOther;
  result.difference = closest.onOne - closest.onOther;
  result.distance = std::sqrt(closest.squaredDistance);
  result.featureNormal = closest.featureNormal;
  result.upper = result.distance + local.slack;
  result.clearance.fill(-local.slack);  // nhat = 0 proves that a distance is not below zero
  tryDirection(local, result.difference, result);
  if (result.distance < internal::kNoisyDirection * extent) {
    tryDirection(local, closest.featureNormal, result);
    tryDirection(local, -closest.featureNormal, result);
  }
  return result;
}

}  // namespace foretouch
