#include "bench/peers/bullet_pairs.h"

#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <algorithm>
#include <cmath>

#include "bench/peers/bullet_capsule.h"

namespace foretouch::tools {
namespace {

class BulletPair final : public PairSolver {
 public:
  /// `mostTurn`: that of one cast (radians); zero: the whole motion is one.
  BulletPair(const char* name, double mostTurn) : PairSolver(name), mostTurn_(mostTurn) {}

  SweepAnswer solve(const MovingPair& pair) override {
    const double turn = std::max(pair.one.turn.norm(), pair.other.turn.norm());
    const int pieces =
        mostTurn_ > 0.0 ? std::max(1, static_cast<int>(std::ceil(turn / mostTurn_))) : 1;
    btTransform one = toBullet(poseAt(pair.one, 0.0)), other = toBullet(poseAt(pair.other, 0.0));
    for (int piece = 0; piece < pieces; ++piece) {
      const double end = static_cast<double>(piece + 1) / pieces;
      const btTransform oneTo = toBullet(poseAt(pair.one, end)),
                        otherTo = toBullet(poseAt(pair.other, end));
      btVoronoiSimplexSolver simplex;
      btGjkEpaPenetrationDepthSolver penetration;
      btContinuousConvexCollision collision(&capsule_.shape(), &capsule_.shape(), &simplex,
                                            &penetration);
      btConvexCast::CastResult result;
      result.m_fraction = 1.0;
      if (collision.calcTimeOfImpact(one, oneTo, other, otherTo, result)) {
        return {true, (piece + std::max(static_cast<double>(result.m_fraction), 0.0)) / pieces};
      }
      one = oneTo;
      other = otherTo;
    }
    return {false, 1.0};
  }

 private:
  BulletCapsule capsule_{movingLss()};
  double mostTurn_;
};

}  // namespace

PairSolvers bulletPairSolvers() {
  PairSolvers solvers;
  solvers.push_back(
      std::make_unique<BulletPair>("Bullet btContinuousConvexCollision, whole motion", 0.0));
  solvers.push_back(std::make_unique<BulletPair>(
      "Bullet btContinuousConvexCollision, pieces of 0.78 rad", kMostTurnOfCast));
  return solvers;
}

}  // namespace foretouch::tools
