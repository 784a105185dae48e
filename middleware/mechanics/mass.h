// middleware/mechanics/mass.h: how heavy bodies and links are, and how hard to turn; how an
// articulated body answers impulses: as a ragdoll of its masses, at one pose, in O(joints)
// ([Featherstone08] 7, REFERENCES.md); and what a collision does to those that collide: the impulse
// of restitution and Coulomb friction at one point. Pure functions. Why energy never grows:
// impulse.md. Kilograms, metres, newton seconds, in W.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "lss/lss.h"

namespace foretouch {

/// How a pair of surfaces bounces and rubs.
struct ContactMaterial {
  double restitution = 0.0;  ///< 0: they stay together, 1: they part as fast as they met.
  double friction = 0.5;     ///< Coulomb's coefficient: 0: ice.
};

/// A point where a and b meet, as a WorldContact has it. In W.
struct CollisionPoint {
  Eigen::Vector3d nhat_BA_W = Eigen::Vector3d::UnitY();  ///< Unit, from b to a.
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();  ///< a's point less b's (m/s).
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

/// The mass that meets the other's along the normal (kg): for a ball that hits a wall, the
/// ball's. Infinite if neither can be moved. What a haptic device needs beside the speed.
[[nodiscard]] double effectiveMass(const CollisionPoint& point);

/// Newton's restitution along the normal, Coulomb's friction across it. Nothing if they part, if
/// neither can be moved, or where an input is not finite. The impulse pushes, stays in the cone of
/// friction, and never adds kinetic energy. Restitution is taken into [0, 1], friction to at least
/// 0. O(1).
[[nodiscard]] CollisionImpulse collisionImpulse(const CollisionPoint& point,
                                                const ContactMaterial& material);

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

/// A solid LSS of `density` (kg/m3): a cylinder and two half spheres. All zero for radius 0.
[[nodiscard]] Mass massOf(const Lss& lss, double density);

/// The mass of two bodies that are one. All zero if neither weighs anything.
[[nodiscard]] Mass sumOf(const Mass& one, const Mass& other);

/// The masses of an avatar's links, kg in all, each in its link's frame: every LSS solid, all of
/// the same density. What two LSS share is counted twice. A link without LSS weighs nothing.
/// Errors: kg not finite or not above 0 (OutOfRange), LSS of no volume at all (Empty).
Result<std::vector<Mass>> massesOfLinks(const Avatar& avatar, double kg);

/// How a free body's point p_W answers an impulse there: velocity change (m/s) per N s. Symmetric,
/// and positive for every direction. `pose`: of B in W. The mass as checkedMass() gives it.
[[nodiscard]] Eigen::Matrix3d inverseMassAt(const Mass& mass, const RigidPose& pose,
                                            const Eigen::Vector3d& p_W);

/// By how much the motion of a link changes at once.
struct VelocityChange {
  Eigen::Vector3d w_WL = Eigen::Vector3d::Zero();  ///< Change of its angular velocity (rad/s).
  Eigen::Vector3d v_WL = Eigen::Vector3d::Zero();  ///< Change of its origin's velocity (m/s).
};

/// Every joint turns freely about its origin, as in the in-between motion, and roots move freely;
/// no muscle holds it. One thread at a time.
class AvatarMass {
 public:
  /// `masses`: per link, in its frame, as massesOfLinks() or a table gives them; a link may weigh
  /// nothing (all zero: then a millionth of what it carries, at 10 cm, resists its turns), but each
  /// root must carry something. Errors: their number (Mismatch), one
  /// that checkedMass() refuses, a root without mass (Empty); Error::index is the link.
  static Result<AvatarMass> build(const Skeleton& skeleton, std::vector<Mass> masses);
  AvatarMass(AvatarMass&&) noexcept;
  AvatarMass& operator=(AvatarMass&&) noexcept;
  ~AvatarMass();

  [[nodiscard]] std::int32_t numLinks() const;
  /// Where the links are: as ChainMotion::statesAt() gives them. O(joints), nothing allocated.
  void place(const std::vector<LinkState>& states);

  /// How the link's point that is at p_W answers an impulse there: velocity change per N s.
  /// Symmetric. O(joints).
  [[nodiscard]] Eigen::Matrix3d inverseMassAt(LinkId link, const Eigen::Vector3d& p_W) const;
  /// How the point of `one` moves against the point of `other`, of the same avatar, if opposite
  /// impulses act on the two.
  [[nodiscard]] Eigen::Matrix3d inverseMassBetween(LinkId one, const Eigen::Vector3d& pOne_W,
                                                   LinkId other,
                                                   const Eigen::Vector3d& pOther_W) const;

  /// What the impulse at the link's point p_W does to every link: linear momentum to 1e-12,
  /// and to 1e-4 where links in a row weigh nothing.
  /// O(joints).
  void respond(LinkId link, const Eigen::Vector3d& p_W, const Eigen::Vector3d& impulse_W,
               std::vector<VelocityChange>& changes) const;

 private:
  struct Parts;
  explicit AvatarMass(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace foretouch
