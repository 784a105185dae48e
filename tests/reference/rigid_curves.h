// tests/reference/rigid_curves.h: the paths of a triangle's vertices under a nlerp motion,
// multiplied by |q|^2: cubics in t. Derivation and rounding: tests/reference/rigid_query.md.
//
#pragma once

#include <array>

#include <Eigen/Core>

#include "lss/separation.h"
#include "tests/reference/cubic.h"
#include "tests/reference/nlerp_motion.h"

namespace foretouch::internal {

/// Rounding of every value computed from the curves, relative to RigidCurves::scale()
/// (rigid_query.md 3); a test checks it with fifty digits. Doubling it doubles the distance of near
/// misses reported as contact; halving it breaks the proof.
inline constexpr double kRigidRounding = 128.0 * kUnitRoundoff;

/// Positions are relative to the fixed triangle's first vertex, metres.
class RigidCurves {
 public:
  RigidCurves(const NlerpMotion& motion, const Triangle& moving_L, const Eigen::Vector3d& origin_W);

  /// Control points of |q|^2 R(q) v, a quadratic, for a vector of the body.
  using Turned = std::array<Eigen::Vector3d, 3>;
  [[nodiscard]] Turned turned(const Eigen::Vector3d& v) const;
  /// n.(translation - f), for a quadratic direction n.
  [[nodiscard]] Cubic towards(const Turned& n, const Eigen::Vector3d& f) const;
  [[nodiscard]] Quaternion rotationAt(double t) const;
  /// |q(t)|^2 as a cubic.
  [[nodiscard]] const Cubic& weight() const { return weight_; }
  /// n.(weight * position of vertex i), for a direction no longer than 1.
  [[nodiscard]] Cubic along(const Eigen::Vector3d& n, int i) const;
  /// The moving triangle at t; each vertex off by at most positionError(t).
  [[nodiscard]] Triangle at(double t) const;
  [[nodiscard]] double positionError(double t) const {
    return kRigidRounding * scale_ / valueAt(weight_, t);
  }
  /// Largest |q|^2 times the extents of translation and triangle (m): values of `along` are off by
  /// at most kRigidRounding of it.
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] double largestWeight() const { return largestWeight_; }

 private:
  std::array<std::array<Eigen::Vector3d, 4>, 3> curves_;  // Bernstein control points
  Quaternion q0_, q1_;
  Eigen::Vector3d c0_, c1_;  // translation, relative to the origin
  Cubic weight_;
  double scale_, largestWeight_;
};

/// A quadratic's coefficients as a cubic's.
inline Cubic elevated(double a, double b, double c) {
  return {a, (a + 2.0 * b) / 3.0, (2.0 * b + c) / 3.0, c};
}

}  // namespace foretouch::internal
