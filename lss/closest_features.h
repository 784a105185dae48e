// lss/closest_features.h: the feature pairs of closest-point searches: edge and edge, point and
// face. Derivation and degenerate cases: lss/segment_triangle.md. Not installed.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace foretouch::internal {

/// Below this squared sine of the angle between two edges, the crossing point of the two lines is
/// too noisy to trust alone, so the search also tries the four end points. Doubling it costs only
/// time.
inline constexpr double kNearParallelSin2 = 1e-6;

inline double clamp01(double x) {
  return std::min(1.0, std::max(0.0, x));
}

/// Closest pair so far of two sets, both in the same local coordinates.
struct Closest {
  double squaredDistance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d onOne = Eigen::Vector3d::Zero();
  Eigen::Vector3d onOther = Eigen::Vector3d::Zero();
  Eigen::Vector3d featureNormal = Eigen::Vector3d::Zero();

  void offer(const Eigen::Vector3d& one, const Eigen::Vector3d& other,
             const Eigen::Vector3d& normal) {
    const double d2 = (one - other).squaredNorm();
    if (d2 < squaredDistance) {
      squaredDistance = d2;
      onOne = one;
      onOther = other;
      featureNormal = normal;
    }
  }
};

/// The edge a + s*u, s in [0,1].
struct Edge {
  Eigen::Vector3d a, u;
  double uu;
  Edge(const Eigen::Vector3d& start, const Eigen::Vector3d& along)
      : a(start), u(along), uu(along.squaredNorm()) {}
  [[nodiscard]] Eigen::Vector3d at(double s) const { return a + s * u; }
  [[nodiscard]] double project(const Eigen::Vector3d& p) const {
    return uu > 0.0 ? clamp01((p - a).dot(u) / uu) : 0.0;
  }
};

/// Offers the closest points of two edges. Clamped line-line solution after [Ericson05] 5.1.9,
/// which also tries the end points if the two are nearly parallel (segment_triangle.md, section 3).
inline void offerEdges(const Edge& one, const Edge& other, Closest& best) {
  using Eigen::Vector3d;
  const double uv = one.u.dot(other.u);
  const double scale = one.uu * other.uu;
  const double determinant = scale - uv * uv;
  if (determinant > 0.0) {
    const Vector3d w = one.a - other.a;
    const double s = clamp01((uv * other.u.dot(w) - other.uu * one.u.dot(w)) / determinant);
    const double t = other.project(one.at(s));
    const double sBack = one.project(other.at(t));
    const bool trusted = determinant > kNearParallelSin2 * scale;
    const bool inside = trusted && sBack > 0.0 && sBack < 1.0 && t > 0.0 && t < 1.0;
    best.offer(one.at(sBack), other.at(t),
               inside ? Vector3d(one.u.cross(other.u)) : Vector3d(Vector3d::Zero()));
    if (trusted) return;
  }
  for (const double end : {0.0, 1.0}) {
    const Vector3d onOne = one.at(end), onOther = other.at(end);
    best.offer(onOne, other.at(other.project(onOne)), Vector3d::Zero());
    best.offer(one.at(one.project(onOther)), onOther, Vector3d::Zero());
  }
}

/// A triangle's face: corner v0, edges e1 and e2 from it, normal e1 x e2.
struct Face {
  Eigen::Vector3d v0, e1, e2, normal;
  double nn;

  Face(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2)
      : v0(corner), e1(edge1), e2(edge2), normal(edge1.cross(edge2)), nn(normal.squaredNorm()) {}

  [[nodiscard]] bool hasArea() const { return nn > 0.0; }
  [[nodiscard]] double height(const Eigen::Vector3d& p) const { return normal.dot(p - v0); }

  /// The projection of `p` along the normal; false if it falls outside. Precondition: hasArea().
  [[nodiscard]] bool project(const Eigen::Vector3d& p, Eigen::Vector3d& onFace) const {
    const Eigen::Vector3d w = p - v0;
    const double beta = w.cross(e2).dot(normal) / nn;
    const double gamma = e1.cross(w).dot(normal) / nn;
    if (!(beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0)) return false;
    onFace = v0 + beta * e1 + gamma * e2;
    return true;
  }

  /// Whether the segment between two points of these heights crosses the face's plane: the two
  /// are on different sides.
  [[nodiscard]] static bool crosses(double heightA, double heightB) {
    return (heightA > 0.0) != (heightB > 0.0) && heightA != heightB;
  }
};

}  // namespace foretouch::internal
