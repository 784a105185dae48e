// tools/colliders/capsule_forms.h: a link's LSS as other tools state capsules, in numbers that
// their files hold, and never smaller. Metres, in the link's frame.
#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/skeleton.h"
#include "lss/lss.h"

namespace foretouch::tools {

/// The precision with which the tools that read a file compute; its numbers have that precision.
enum class HeldAs : std::uint8_t { Floats, Doubles };

/// An axis shorter than this is a sphere's (m): below it tools take a capsule for a broken one
/// (MuJoCo below 1e-15 m, glTF at 0), and a sphere that holds it is no thicker than this.
inline constexpr double kLeastAxis = 1e-6;
/// No collider is thinner (m): tools refuse a radius of 0, or take it for a mistake.
inline constexpr double kLeastRadius = 1e-6;

/// The same LSS as a sphere where its axis is shorter than kLeastAxis, and with at least
/// kLeastRadius. Holds the LSS.
[[nodiscard]] Lss asCollider(const Lss& lss);

/// The capsule by its ends. Holds `lss`: a larger radius makes up for the rounding of the ends.
[[nodiscard]] Lss byEnds(const Lss& lss, HeldAs held);

/// A capsule by its middle and the turn of the tool's axis, +Y or +Z. A sphere has halfLength 0.
struct StandingCapsule {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Quaternion turn = Quaternion::Identity();  ///< Brings the tool's axis to the LSS'.
  double halfLength = 0.0;                   ///< From the middle to the centre of either cap, m.
  double radius = 0.0;
};

/// Holds `lss`, whether a tool takes the turn as it is, makes it unit, or makes a matrix of it
/// whose elements are rounded in the same way (turnMatrix()). `axis` is a unit vector.
[[nodiscard]] StandingCapsule standing(const Lss& lss, const Eigen::Vector3d& axis, HeldAs held);

/// The turn as a matrix of numbers of that precision.
[[nodiscard]] Eigen::Matrix3d turnMatrix(const Quaternion& turn, HeldAs held);

/// The whole height of a capsule, so that height / 2 - radius is no less than its half length.
[[nodiscard]] double wholeHeight(const StandingCapsule& capsule, HeldAs held);

/// The nearest number that such a file can hold, and the least one that is not below `number`.
[[nodiscard]] double heldNumber(double number, HeldAs held);
[[nodiscard]] double heldAbove(double number, HeldAs held);

}  // namespace foretouch::tools
