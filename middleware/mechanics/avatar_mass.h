// middleware/mechanics/avatar_mass.h: how an articulated body answers impulses: as a ragdoll of
// its masses, at one pose, in O(joints) ([Featherstone08] 7, REFERENCES.md). Kilograms, metres,
// newton seconds, in W.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/mechanics/mass.h"

namespace foretouch {

/// By how much the motion of a link changes at once.
struct VelocityChange {
  Eigen::Vector3d w_WL = Eigen::Vector3d::Zero();  ///< Of its angular velocity (rad/s).
  Eigen::Vector3d v_WL = Eigen::Vector3d::Zero();  ///< Of its origin's velocity (m/s).
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
