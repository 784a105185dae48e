#include "middleware/exact/rigid_curves.h"

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
                         const Vector3d& origin_W) {
  const Quaternion &q0 = motion.q0, &q1 = motion.q1;
  const double w0 = q0.coeffs().squaredNorm(), w2 = q1.coeffs().squaredNorm();
  const double w1 = q0.coeffs().dot(q1.coeffs());
  weight_ = {w0, (w0 + 2.0 * w1) / 3.0, (2.0 * w1 + w2) / 3.0, w2};
  const Vector3d c0 = motion.x0 - origin_W, c1 = motion.x1 - origin_W;
  double extent = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d& p = moving_L.vertices[i];
    const Vector3d m0 = rotationForm(q0, q0, p), m1 = rotationForm(q0, q1, p);
    const Vector3d m2 = rotationForm(q1, q1, p);
    curves_[i] = {m0 + w0 * c0, (m0 + 2.0 * m1 + (w0 * c1 + 2.0 * w1 * c0)) / 3.0,
                  (2.0 * m1 + m2 + (2.0 * w1 * c1 + w2 * c0)) / 3.0, m2 + w2 * c1};
    extent = std::max(extent, p.lpNorm<1>());
  }
  extent += std::max(c0.lpNorm<1>(), c1.lpNorm<1>());
  largestWeight_ = std::max(w0, w2);
  scale_ = largestWeight_ * extent;
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
