// tests/reference/nlerp_motion.h: a rigid body whose translation and quaternion are both
// linear in t (the quaternion unnormalised: nlerp), and when it comes near a triangle at rest.
#pragma once

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "tests/reference/leaf.h"

namespace foretouch {

/// x(t) = x0 + t*(x1 - x0), q(t) = q0 + t*(q1 - q0); a point p of the body is at x + R(q)p. The
/// quaternions need not be unit. Precondition: q0.q1 >= 0 and both have norm in [0.5, 2]
/// (asserted), so that |q(t)| > 0.
struct NlerpMotion {
  Eigen::Vector3d x0, x1;
  Quaternion q0, q1;
};

/// The first instant at which the proof that the separation exceeds `band` (metres, >= 0) ends.
/// Sound: if not `hits`, separation > band on all of [0,1]; if `hits`, separation > band on [0,
/// toiLow). Tight: at some instant of [toiLow, toiHigh] the separation is at most band +
/// rigidBand(...).
struct RigidAnswer {
  LeafAnswer leaf;               ///< `stage` is Filter.
  bool startsInContact = false;  ///< Separation <= band at t = 0, up to rigidBand().
  Feature moving, fixed;
};

}  // namespace foretouch
