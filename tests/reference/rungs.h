// tests/reference/rungs.h: volumes that each cover several of an avatar's links on one step, which
// the product once offered as fidelities above the links. Metres. Proof that each contains those
// below it at every t in [0,1]: tests/reference/rungs.md.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// Which volume stands for the links that it covers, which share its verdict. From fine to coarse:
/// each contains those of the rung before, and the links' own LSS, at every t. So clear at one rung
/// implies no contact at any finer one, and a coarser rung never reports a contact later.
enum class Rung : std::uint8_t {
  Limb,    ///< One LSS for all links of a chain between branchings (a finger, an arm to the hand).
  Avatar,  ///< One LSS for all links; with several roots, one LSS per root.
  Ellipsoid,  ///< An ellipsoid of revolution around that LSS, which moves on a straight line.
};

/// "limb", "avatar", "ellipsoid".
[[nodiscard]] const char* toString(Rung rung);

/// An ellipsoid of revolution that moves on a straight line and does not turn:
/// the points x with |S(x - start - t*drift)| <= 1, S = 1/across + (1/along - 1/across) axis axis'.
struct Spheroid {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< Its centre at t = 0, in W.
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();  ///< Of the centre, per unit of t.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< Of revolution; unit.
  double along = 0.0, across = 0.0;                 ///< Semi-axes, > 0.

  /// S x: into the space where the spheroid is the unit ball.
  [[nodiscard]] Eigen::Vector3d toUnit(const Eigen::Vector3d& x) const {
    return x / across + ((1.0 / along - 1.0 / across) * axis.dot(x)) * axis;
  }
  /// The inverse of S, to rounding.
  [[nodiscard]] Eigen::Vector3d fromUnit(const Eigen::Vector3d& x) const {
    return across * x + ((along - across) * axis.dot(x)) * axis;
  }
  /// Of the semi-axes.
  [[nodiscard]] double longest() const { return along > across ? along : across; }
  [[nodiscard]] double shortest() const { return along < across ? along : across; }
  [[nodiscard]] Eigen::Vector3d centerAt(double t) const { return start + t * drift; }
};

struct RungVolume {
  LinkId carrier = 0;         ///< In whose frame the LSS is fixed.
  std::vector<LinkId> links;  ///< Those it covers, ascending; all have LSS.
  Lss lss;                    ///< For Limb and Avatar the volume; for Ellipsoid the LSS inside it.
  Spheroid spheroid;          ///< For Ellipsoid.
};

/// In the order of their carriers. The scene's origin only affects how the volumes round. O(LSS).
[[nodiscard]] std::vector<RungVolume> rungVolumes(const Avatar& avatar, const ChainMotion& motion,
                                                  const Scene& scene, Rung rung);

}  // namespace foretouch
