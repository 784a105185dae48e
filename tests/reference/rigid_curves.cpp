#include "tests/reference/rigid_curves.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// The form whose diagonal is M(q) p = |q|^2 R(q) p: bilinear and symmetric in the quaternions.
Vector3d rotationForm(const Quaternion& a, const Quaternion& b, const Vector3d& p) {
  const Vector3d va = a.vec(), vb = b.vec();
  return (a.w() * b.w() - va.dot(vb)) * p + va.dot(p) * vb + vb.dot(p) * va + a.w() * vb.cross(p) +
         b.w() * va.cross(p);
}

}  // namespace

RigidCurves::RigidCurves(const NlerpMotion& motion, const Triangle& moving_L,
                         const Vector3d& origin_W)
    : q0_(motion.q0), q1_(motion.q1), c0_(motion.x0 - origin_W), c1_(motion.x1 - origin_W) {
  const double w0 = q0_.coeffs().squaredNorm(), w2 = q1_.coeffs().squaredNorm();
  const double w1 = q0_.coeffs().dot(q1_.coeffs());
  weight_ = elevated(w0, w1, w2);
  double extent = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d& p = moving_L.vertices[i];
    const auto [m0, m1, m2] = turned(p);
    curves_[i] = {m0 + w0 * c0_, (m0 + 2.0 * m1 + (w0 * c1_ + 2.0 * w1 * c0_)) / 3.0,
                  (2.0 * m1 + m2 + (2.0 * w1 * c1_ + w2 * c0_)) / 3.0, m2 + w2 * c1_};
    extent = std::max(extent, p.lpNorm<1>());
  }
  extent += std::max(c0_.lpNorm<1>(), c1_.lpNorm<1>());
  largestWeight_ = std::max(w0, w2);
  scale_ = largestWeight_ * extent;
}

RigidCurves::Turned RigidCurves::turned(const Vector3d& v) const {
  return {rotationForm(q0_, q0_, v), rotationForm(q0_, q1_, v), rotationForm(q1_, q1_, v)};
}

Cubic RigidCurves::towards(const Turned& n, const Vector3d& f) const {
  const Vector3d from = c0_ - f, to = c1_ - f;
  return {n[0].dot(from), (n[0].dot(to) + 2.0 * n[1].dot(from)) / 3.0,
          (2.0 * n[1].dot(to) + n[2].dot(from)) / 3.0, n[2].dot(to)};
}

Quaternion RigidCurves::rotationAt(double t) const {
  const Eigen::Vector4d q = (1.0 - t) * q0_.coeffs() + t * q1_.coeffs();
  return Quaternion(Eigen::Vector4d(q.normalized()));
}

Cubic RigidCurves::along(const Vector3d& n, int i) const {
  const auto& c = curves_[i];
  return {n.dot(c[0]), n.dot(c[1]), n.dot(c[2]), n.dot(c[3])};
}

Triangle RigidCurves::at(double t) const {
  Triangle triangle;
  const double weight = valueAt(weight_, t);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto& c = curves_[i];
      triangle.vertices[i][axis] =
          valueAt({c[0][axis], c[1][axis], c[2][axis], c[3][axis]}, t) / weight;
    }
  }
  return triangle;
}

}  // namespace foretouch::internal
