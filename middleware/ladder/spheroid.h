// middleware/ladder/spheroid.h: the ellipsoid rung. One ellipsoid of revolution around a tree's LSS
// at every t of a step: it moves with the root's origin, on a straight line, and does not turn; how
// the body turns meanwhile is in its size. As games move a character [Fauerby03], but around the
// whole body and with a proof. Derivation: middleware/ladder/rungs.md 5. Metres. Not installed.
#pragma once

#include <Eigen/Core>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "lss/triangle.h"
#include "middleware/query.h"

namespace foretouch::internal {

/// The points x with |S(x - start - t*drift)| <= 1, S = 1/across + (1/along - 1/across) axis axis'.
struct Spheroid {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< Its centre at t = 0, in W.
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();  ///< Of the centre, per unit of t.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< Of revolution; unit.
  double along = 0.0, across = 0.0;                 ///< Semi-axes, > 0.

  /// S x: into the space where it is the unit ball.
  [[nodiscard]] Eigen::Vector3d toUnit(const Eigen::Vector3d& x) const {
    return x / across + ((1.0 / along - 1.0 / across) * axis.dot(x)) * axis;
  }
  /// The inverse of S, to rounding.
  [[nodiscard]] Eigen::Vector3d fromUnit(const Eigen::Vector3d& x) const {
    return across * x + ((along - across) * axis.dot(x)) * axis;
  }
  [[nodiscard]] double longest() const { return along > across ? along : across; }
  [[nodiscard]] double shortest() const { return along < across ? along : across; }
  [[nodiscard]] Eigen::Vector3d centerAt(double t) const { return start + t * drift; }
};

/// Around `volume`, which is fixed in the frame of `root`, a link without a parent. `nodes` are of
/// `motion` over [0,1].
[[nodiscard]] Spheroid spheroidAround(const Lss& volume, LinkId root, const ChainMotion& motion,
                                      const ChainNodes& nodes);

/// The spheroid and a triangle at one instant, in the space where the spheroid is the unit ball and
/// sits at the origin at t = 0.
class SpheroidPair {
 public:
  SpheroidPair(const Spheroid& spheroid, const Triangle& triangle);

  struct Look {
    Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< From the triangle; |nhat| <= 1.
    double lower = 0.0;  ///< Proven: the plane's clearance of the ball.
    double upper = 0.0;  ///< Proven: of their distance.
    Eigen::Vector3d onTriangle = Eigen::Vector3d::Zero();
  };
  [[nodiscard]] Look at(double t) const;
  /// Up to which t, from `t` on, the plane of `look` keeps `floor` to the ball; at most 1.
  [[nodiscard]] double provenFrom(double t, const Look& look, double floor) const;

 private:
  Triangle unit_;
  Eigen::Vector3d velocity_;
  double slack_;
};

}  // namespace foretouch::internal
