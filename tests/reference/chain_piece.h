// tests/reference/chain_piece.h: a span of a chain's motion as a nlerp body, whose cubics
// bound it within a certified band.
//
// Over a span both motions have the same end poses; a point with |acceleration| <= A stays within
// A*h^2/8 of its chord, so the two paths are apart by at most the sum of the two bounds
// (tests/reference/rigid_query.md, last section).
#pragma once

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/pair/provers.h"
#include "tests/reference/rigid_query.h"

namespace foretouch::internal {

struct ChainPiece {
  NlerpMotion motion;
  double deviation = 0.0;  ///< Metres, rounded up: of points within `rho` of the link's origin.
};

/// The link from state `begin` to state `end`, `span` apart in t.
[[nodiscard]] ChainPiece chainPiece(const LinkState& begin, const LinkState& end, double span,
                                    const MotionBounds& bounds, double rho);

/// Up to which t a triangle of the link is proven to keep more than `floor` away from a triangle of
/// the scene, from `t` on and not beyond `horizon`; `t` itself if nothing is proven. One piece,
/// short enough that its deviation is at most `band`. `nhat_W` as in rigidTrianglePairFromPlane().
[[nodiscard]] double freeUntilByCubics(MotionEvaluator& states, LinkId link, double t,
                                       double horizon, const Triangle& part_L,
                                       const Triangle& fixed_W, double floor, double band,
                                       const Eigen::Vector3d& nhat_W);

/// freeUntilByCubics() for the pairs of a query, with the query's floor as the band.
class CubicsProver final : public LeafProver {
 public:
  [[nodiscard]] double freeUntil(const LinkQuery& query, const Candidate& candidate,
                                 const MovingPair& pair, double t,
                                 QueryCounters& counters) const override;
};

}  // namespace foretouch::internal
