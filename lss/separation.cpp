#include "lss/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/clearance.h"
#include "lss/closest_features.h"
#include "lss/index.h"
#include "lss/segment_triangle.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Closest;
using internal::Edge;
using internal::Face;

/// Both hulls relative to the other's first point.
struct LocalHulls {
  std::array<Vector3d, 3> one, other;  // other[0] = 0
  int numOne, numOther;
  double extent;  // the sum of the points' 1-norms, which are never below the 2-norms
  double slack;   // of the bounds, for rounding
};

LocalHulls localOf(const Hull& one, const Hull& other) {
  const Vector3d& origin = other.points[0];
  LocalHulls local{{}, {}, one.count, other.count, 0.0, 0.0};
  for (std::size_t i = 0; i < countOf(one.count); ++i) {
    local.one[i] = one.points[i] - origin;
    local.extent += local.one[i].lpNorm<1>();
  }
  for (std::size_t j = 0; j < countOf(other.count); ++j) {
    local.other[j] = other.points[j] - origin;
    local.extent += local.other[j].lpNorm<1>();
  }
  local.slack = kSeparationRounding * local.extent + internal::kUnderflow;
  return local;
}

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

Closest closestOfTriangles(const LocalHulls& local) {
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

Closest closestOfSegments(const LocalHulls& local) {
  Closest best;
  offerEdges(Edge(local.one[0], local.one[1] - local.one[0]), Edge(local.other[0], local.other[1]),
             best);
  return best;
}

void takeClosest(const Closest& closest, const Vector3d& origin, Separation& result) {
  result.onOne = origin + closest.onOne;
  result.onOther = origin + closest.onOther;
  result.difference = closest.onOne - closest.onOther;
  result.distance = std::sqrt(closest.squaredDistance);
  result.featureNormal = closest.featureNormal;
}

/// `sign`: +1 if `one` is the segment, -1 if `other` is.
void takeClosest(const ClosestPoints& closest, double sign, Separation& result) {
  const bool isOneSegment = sign > 0.0;
  result.onOne = isOneSegment ? closest.onSegment : closest.onTriangle;
  result.onOther = isOneSegment ? closest.onTriangle : closest.onSegment;
  result.difference = sign * closest.difference;
  result.distance = closest.distance;
  result.featureNormal = closest.featureNormal;
}

void findClosest(const Hull& one, const Hull& other, const LocalHulls& local, Separation& result) {
  const Vector3d& origin = other.points[0];
  if (one.count == 2 && other.count == 3) {
    takeClosest(closestPoints(one.points[0], one.points[1], other.triangle()), 1.0, result);
  } else if (one.count == 3 && other.count == 2) {
    takeClosest(closestPoints(other.points[0], other.points[1], one.triangle()), -1.0, result);
  } else if (one.count == 3) {
    takeClosest(closestOfTriangles(local), origin, result);
  } else {
    takeClosest(closestOfSegments(local), origin, result);
  }
}

void tryDirection(const LocalHulls& local, const Vector3d& direction, Separation& best) {
  const double norm = direction.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return;
  const Vector3d nhat = (internal::kUnitShrink / norm) * direction;
  std::array<double, 3> height{0.0, nhat.dot(local.other[1]), 0.0};
  double top = std::max(0.0, height[1]);
  if (local.numOther == 3) {
    height[2] = nhat.dot(local.other[2]);
    top = std::max(top, height[2]);
  }
  std::array<double, 3> clearance{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < countOf(local.numOne); ++i) {
    clearance[i] = nhat.dot(local.one[i]) - top - local.slack;
    least = std::min(least, clearance[i]);
  }
  if (!(least > best.lower())) return;
  best.nhat = nhat;
  best.clearance = clearance;
  for (std::size_t j = 0; j < countOf(local.numOther); ++j) best.spare[j] = top - height[j];
}

}  // namespace

Separation separation(const Hull& one, const Hull& other) {
  const LocalHulls local = localOf(one, other);
  Separation result;
  result.numOne = one.count;
  result.numOther = other.count;
  findClosest(one, other, local, result);
  result.upper = result.distance + local.slack;
  result.clearance.fill(-local.slack);  // nhat = 0 proves that a distance is not below zero
  tryDirection(local, result.difference, result);
  if (result.distance < internal::kNoisyDirection * local.extent) {
    tryDirection(local, result.featureNormal, result);
    tryDirection(local, -result.featureNormal, result);
  }
  return result;
}

double clearanceAlong(const Hull& one, const Hull& other, const Eigen::Vector3d& direction) {
  const LocalHulls local = localOf(one, other);
  Separation result;
  result.numOne = one.count;
  result.numOther = other.count;
  result.clearance.fill(-local.slack);
  tryDirection(local, direction, result);
  return result.lower();
}

double gapAlong(const Hull& one, const Hull& other, const Eigen::Vector3d& nhat) {
  const LocalHulls local = localOf(one, other);
  double least = std::numeric_limits<double>::infinity(), top = 0.0;  // local.other[0] = 0
  for (std::size_t i = 0; i < countOf(local.numOne); ++i) {
    least = std::min(least, nhat.dot(local.one[i]));
  }
  for (std::size_t j = 1; j < countOf(local.numOther); ++j) {
    top = std::max(top, nhat.dot(local.other[j]));
  }
  return least - top - local.slack;
}

}  // namespace foretouch
