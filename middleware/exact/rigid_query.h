// middleware/exact/rigid_query.h: a triangle of a rigid body whose translation and quaternion are
// both linear in t (the quaternion unnormalised: nlerp) against a triangle at rest. Multiplied by
// |q|^2 every contact function is a cubic in t ([Canny86]; middleware/exact/rigid_query.md derives
// them). Decided by signs beyond proved rounding bounds, in doubles. A few rounds; each costs about
// a microsecond.
#pragma once

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "lss/triangle.h"
#include "middleware/exact/leaf.h"

namespace foretouch {

/// x(t) = x0 + t*(x1 - x0), q(t) = q0 + t*(q1 - q0); a point p of the body is at x + R(q)p. The
/// quaternions need not be unit. Precondition: q0.q1 >= 0 and both have norm in [0.5, 2]
/// (asserted), so that |q(t)| > 0.
struct NlerpMotion {
  Eigen::Vector3d x0, x1;
  Quaternion q0, q1;
};

/// The first instant at which the separation is no longer proved to exceed `band` (metres, >= 0).
/// Sound: where not `hits`, separation > band on all of [0,1]; where `hits`, separation > band on
/// [0, toiLow). Tight: at some instant of [toiLow, toiHigh] the separation is at most
/// band + rigidBand(...).
struct RigidAnswer {
  LeafAnswer leaf;               ///< `stage` is Filter.
  bool startsInContact = false;  ///< Separation <= band at t = 0, up to rigidBand().
  Feature moving, fixed;
};
[[nodiscard]] RigidAnswer rigidTrianglePair(const NlerpMotion& motion, const Triangle& moving_L,
                                            const Triangle& fixed_W, double band);

/// Metres: how near a miss may be that is reported as contact (rounding that doubles cannot
/// tell from contact). `extent`: the largest of |coordinate| of the translation and
/// of the fixed triangle, both relative to the fixed triangle's first vertex, of |coordinate| of
/// the moving triangle in the body's frame, and of the band.
[[nodiscard]] double rigidBand(double extent);

}  // namespace foretouch
