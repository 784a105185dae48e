// tests/reference/rigid_query.h: a triangle of a rigid body whose translation and quaternion
// are both linear in t (the quaternion unnormalised: nlerp) against a triangle at rest. Multiplied
// by |q|^2 every contact function is a cubic in t ([Canny86]; tests/reference/rigid_query.md
// derives them). Signs beyond proved rounding bounds decide, in doubles. A few rounds of about a
// microsecond each.
#pragma once

#include "lss/lss.h"
#include "tests/reference/nlerp_motion.h"

namespace foretouch {

/// A band (metres, >= 0) about the triangle counts as contact.
[[nodiscard]] RigidAnswer rigidTrianglePair(const NlerpMotion& motion, const Triangle& moving_L,
                                            const Triangle& fixed_W, double band);

/// Metres: a near miss within this distance may be reported as contact (doubles cannot tell the two
/// apart). `extent`: the largest of |coordinate| of the translation and of the fixed triangle, both
/// relative to the fixed triangle's first vertex, of |coordinate| of the moving triangle in the
/// body's frame, and of the band.
[[nodiscard]] double rigidBand(double extent);

}  // namespace foretouch
