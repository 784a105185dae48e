// middleware/ladder/rungs.h: the volumes that cover an avatar's links above link fidelity
// (Fidelity::Limb, Avatar, Ellipsoid) on one step. A query at that fidelity tests these volumes;
// they are public so that you can check its answers. Metres. Proof that each contains those below
// it at every t in [0,1]: middleware/ladder/rungs.md.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/fidelity.h"
#include "middleware/scene/scene.h"

namespace foretouch {

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

/// In the order of their carriers. Precondition: `rung` is Limb, Avatar or Ellipsoid (asserted).
/// The scene's origin only affects how the volumes round. O(LSS).
[[nodiscard]] std::vector<RungVolume> rungVolumes(const Avatar& avatar, const ChainMotion& motion,
                                                  const Scene& scene, Fidelity rung);

}  // namespace foretouch
