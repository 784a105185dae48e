// middleware/mechanics/mass.h: how heavy bodies and links are, and how hard to turn. Kilograms,
// metres.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/pose.h"
#include "articulated/result.h"
#include "lss/lss.h"

namespace foretouch {

/// The mass of a rigid body, in its own frame B.
struct Mass {
  double kg = 0.0;
  Eigen::Vector3d center_B = Eigen::Vector3d::Zero();   ///< Centre of mass.
  Eigen::Matrix3d inertia_B = Eigen::Matrix3d::Zero();  ///< About the centre, axes of B (kg m2).
};

/// The same, if a body can have it: finite, more than 0 kg, an inertia that is symmetric (and is
/// made so to the bit), that turning any way costs, and whose largest principal moment is at most
/// the sum of the other two. Else what is wrong (NonFinite, OutOfRange).
Result<Mass> checkedMass(const Mass& mass);

/// Of a solid LSS of `density` (kg/m3): a cylinder and two half spheres. All zero for radius 0.
[[nodiscard]] Mass massOf(const Lss& lss, double density);

/// Of two bodies that are one. All zero if neither weighs anything.
[[nodiscard]] Mass sumOf(const Mass& one, const Mass& other);

/// The masses of an avatar's links, kg in all, each in its link's frame: every LSS solid, all of
/// the same density. What two LSS share is counted twice. A link without LSS weighs nothing.
/// Errors: kg not finite or not above 0 (OutOfRange), LSS of no volume at all (Empty).
Result<std::vector<Mass>> massesOfLinks(const Avatar& avatar, double kg);

/// How a free body's point p_W answers an impulse there: velocity change (m/s) per N s. Symmetric,
/// and positive for every direction. `pose`: of B in W. The mass as checkedMass() gives it.
[[nodiscard]] Eigen::Matrix3d inverseMassAt(const Mass& mass, const RigidPose& pose,
                                            const Eigen::Vector3d& p_W);

}  // namespace foretouch
