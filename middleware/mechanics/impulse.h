// middleware/mechanics/impulse.h: what a collision does to those that collide: the impulse of
// restitution and Coulomb friction at one point. Pure functions. Why energy never grows:
// impulse.md.
#pragma once

#include <Eigen/Core>

namespace foretouch {

/// How a pair of surfaces bounces and rubs.
struct ContactMaterial {
  double restitution = 0.0;  ///< 0: they stay together, 1: they part as fast as they met.
  double friction = 0.5;     ///< Coulomb's coefficient: 0: ice.
};

/// A point where a and b meet, as a WorldContact has it. In W.
struct CollisionPoint {
  Eigen::Vector3d nhat_BA_W = Eigen::Vector3d::UnitY();  ///< Unit, from b to a.
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();  ///< Of a's point less b's (m/s).
  /// How their points part per N s: the sum of what inverseMassAt() says of a and of b. One that
  /// nothing moves (the scene, a tracked hand) adds nothing. Symmetric.
  Eigen::Matrix3d inverseMass_W = Eigen::Matrix3d::Identity();
};

/// What acts on a; b gets the opposite.
struct CollisionImpulse {
  Eigen::Vector3d onA_W = Eigen::Vector3d::Zero();  ///< N s.
  bool sticks = false;                              ///< They do not slide on each other afterwards.
  /// What was applied: less than asked for where friction at that restitution would have made
  /// energy.
  ContactMaterial applied;
};

/// The mass that meets the mass of the other along the normal (kg): of a ball that hits a wall, the
/// ball's. Infinite if neither can be moved. What a haptic device needs beside the speed.
[[nodiscard]] double effectiveMass(const CollisionPoint& point);

/// Newton's restitution along the normal, Coulomb's friction across it. Nothing if they part, if
/// neither can be moved, or where an input is not finite. The impulse pushes, stays in the cone of
/// friction, and never adds kinetic energy. Restitution is taken into [0, 1], friction to at least
/// 0. O(1).
[[nodiscard]] CollisionImpulse collisionImpulse(const CollisionPoint& point,
                                                const ContactMaterial& material);

}  // namespace foretouch
