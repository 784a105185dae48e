// tests/reference/spheroid.h: the ellipsoid rung. One ellipsoid of revolution around a tree's LSS
// at every t of a step: it moves with the root's origin, on a straight line, and does not turn; it
// is large enough for the body's turning. Games move characters this way [Fauerby03]; this one
// holds the whole body, with a proof. Derivation: tests/reference/rungs.md 5. Metres.
#pragma once

#include <Eigen/Core>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "tests/reference/rungs.h"

namespace foretouch::internal {

/// Around `volume`, which is fixed in the frame of `root`, a link without a parent. `nodes` are of
/// `motion` over [0,1].
[[nodiscard]] Spheroid spheroidAround(const Lss& volume, LinkId root, const ChainMotion& motion,
                                      const ChainNodes& nodes);

/// The spheroid and a triangle at one instant, in the space where the spheroid is the unit ball and
/// sits at the origin at t = 0.
class SpheroidPair {
 public:
  SpheroidPair(const Spheroid& spheroid, const Triangle& triangle);

  /// Lower bounds on the distance of the ball's centre from the triangle, at t = 0 and over all t;
  /// by the triangle's first corner and its longest edge there.
  [[nodiscard]] double leastAtStart() const;
  [[nodiscard]] double leastOfAll() const;

  struct Look {
    Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< From the triangle; |nhat| <= 1.
    double lower = 0.0;                              ///< Proven: the plane's clearance of the ball.
    double upper = 0.0;                              ///< Proven: of their distance.
    Eigen::Vector3d onTriangle = Eigen::Vector3d::Zero();
  };
  [[nodiscard]] Look at(double t) const;
  /// Up to which t, from `t` on, the plane of `look` keeps `floor` to the ball; at most 1.
  [[nodiscard]] double provenFrom(double t, const Look& look, double floor) const;

 private:
  Triangle unit_;
  Eigen::Vector3d velocity_;
  double slack_, longestEdge_;
};

}  // namespace foretouch::internal
