#include "lss/segment_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// Below this squared sine of the angle between axis and edge, the crossing point of the two lines
/// is too noisy to trust alone and the four end points are tried as well. Doubling it costs time
/// only.
constexpr double kNearParallelSin2 = 1e-6;

double clamp01(double x) {
  return std::min(1.0, std::max(0.0, x));
}

/// Closest pair so far, in coordinates relative to the triangle's first vertex.
struct Closest {
  double squaredDistance = std::numeric_limits<double>::infinity();
  Vector3d onSegment = Vector3d::Zero();
  Vector3d onTriangle = Vector3d::Zero();
  Vector3d featureNormal = Vector3d::Zero();

  void offer(const Vector3d& segmentPoint, const Vector3d& trianglePoint, const Vector3d& normal) {
    const double d2 = (segmentPoint - trianglePoint).squaredNorm();
    if (d2 < squaredDistance) {
      squaredDistance = d2;
      onSegment = segmentPoint;
      onTriangle = trianglePoint;
      featureNormal = normal;
    }
  }
};

/// The axis a + s*u, s in [0,1].
struct Axis {
  Vector3d a, u;
  double uu;
  [[nodiscard]] Vector3d at(double s) const { return a + s * u; }
  [[nodiscard]] double project(const Vector3d& p) const {
    return uu > 0.0 ? clamp01((p - a).dot(u) / uu) : 0.0;
  }
};

/// The edge c + t*v against the axis. Clamped line-line solution after [Ericson05] 5.1.9, with the
/// end points tried as well where the two are nearly parallel (segment_triangle.md, section 3).
void offerEdge(const Axis& axis, const Vector3d& c, const Vector3d& v, Closest& best) {
  const Axis edge{c, v, v.squaredNorm()};
  const double uv = axis.u.dot(v);
  const double scale = axis.uu * edge.uu;
  const double determinant = scale - uv * uv;
  if (determinant > kNearParallelSin2 * scale) {
    const Vector3d w = axis.a - c;
    const double s = clamp01((uv * v.dot(w) - edge.uu * axis.u.dot(w)) / determinant);
    const double t = edge.project(axis.at(s));
    const double sBack = axis.project(edge.at(t));
    const bool inside = sBack > 0.0 && sBack < 1.0 && t > 0.0 && t < 1.0;
    best.offer(axis.at(sBack), edge.at(t),
               inside ? Vector3d(axis.u.cross(v)) : Vector3d(Vector3d::Zero()));
    return;
  }
  if (determinant > 0.0) {
    const Vector3d w = axis.a - c;
    const double s = clamp01((uv * v.dot(w) - edge.uu * axis.u.dot(w)) / determinant);
    const double t = edge.project(axis.at(s));
    best.offer(axis.at(axis.project(edge.at(t))), edge.at(t), Vector3d::Zero());
  }
  for (const double end : {0.0, 1.0}) {
    const Vector3d onAxis = axis.at(end), onEdge = edge.at(end);
    best.offer(onAxis, edge.at(edge.project(onAxis)), Vector3d::Zero());
    best.offer(axis.at(axis.project(onEdge)), onEdge, Vector3d::Zero());
  }
}

/// The triangle's face: v0 = 0, edges e1 and e2, normal e1 x e2.
struct Face {
  Vector3d e1, e2, normal;
  double nn;

  /// Offers `onSegment` with its projection along the normal, where that falls inside the face.
  void offerProjection(const Vector3d& onSegment, Closest& best) const {
    const double beta = onSegment.cross(e2).dot(normal) / nn;
    const double gamma = e1.cross(onSegment).dot(normal) / nn;
    if (beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0) {
      best.offer(onSegment, beta * e1 + gamma * e2, normal);
    }
  }
};

void offerFace(const Axis& axis, const Vector3d& b, const Face& face, Closest& best) {
  if (!(face.nn > 0.0)) return;  // no area: the edges are the whole triangle
  const double heightA = face.normal.dot(axis.a);
  const double heightB = face.normal.dot(b);
  if ((heightA > 0.0) != (heightB > 0.0) && heightA != heightB) {
    face.offerProjection(axis.at(clamp01(heightA / (heightA - heightB))), best);
  }
  face.offerProjection(axis.a, best);
  face.offerProjection(b, best);
}

}  // namespace

ClosestPoints closestPoints(const Vector3d& a, const Vector3d& b, const Triangle& triangle) {
  const Vector3d& origin = triangle.vertices[0];
  const Vector3d bLocal = b - origin;
  Axis axis{a - origin, Vector3d::Zero(), 0.0};
  axis.u = bLocal - axis.a;
  axis.uu = axis.u.squaredNorm();
  Face face{triangle.vertices[1] - origin, triangle.vertices[2] - origin, Vector3d::Zero(), 0.0};
  face.normal = face.e1.cross(face.e2);
  face.nn = face.normal.squaredNorm();

  Closest best;
  offerFace(axis, bLocal, face, best);
  offerEdge(axis, Vector3d::Zero(), face.e1, best);
  offerEdge(axis, Vector3d::Zero(), face.e2, best);
  offerEdge(axis, face.e1, triangle.vertices[2] - triangle.vertices[1], best);

  ClosestPoints result;
  result.onSegment = origin + best.onSegment;
  result.onTriangle = origin + best.onTriangle;
  result.difference = best.onSegment - best.onTriangle;
  result.distance = std::sqrt(best.squaredDistance);
  result.featureNormal = best.featureNormal;
  return result;
}

}  // namespace foretouch
