#include "bench/peers/bullet_solvers.h"

#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <algorithm>
#include <array>
#include <btBulletCollisionCommon.h>
#include <cmath>

#include <fmt/format.h>

#include "bench/peers/bullet_capsule.h"
#include "bench/peers/bullet_mesh.h"

namespace foretouch::tools {
namespace {

/// convexSweepTest() collects triangles by the box of the last pose's rotation; finer pieces
/// compensate for that.
constexpr double kFineTurnOfCast = 0.1;

}  // namespace

/// Members in the order of their dependencies.
struct BulletScene::Impl {
  explicit Impl(const std::vector<Triangle>& triangles) : mesh(triangles) {
    object.setCollisionShape(&mesh.shape());
    world.addCollisionObject(&object);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { world.removeCollisionObject(&object); }

  BulletMesh mesh;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  btCollisionObject object;
};

namespace {

using SharedScene = std::shared_ptr<BulletScene::Impl>;

/// A motion cut into equal pieces, cast one by one until one hits.
class BulletSolver : public SweepSolver {
 public:
  /// `mostTurn`: that of one cast (radians); zero: the whole motion is one.
  BulletSolver(const std::string& name, SharedScene scene, const Lss& lss_L, double mostTurn)
      : SweepSolver(name + (mostTurn > 0.0 ? fmt::format(", pieces of {:g} rad", mostTurn)
                                           : std::string(", whole motion")),
                    true),
        scene_(std::move(scene)),
        capsule_(lss_L),
        mostTurn_(mostTurn) {}

  SweepAnswer solve(const RigidSweep& sweep) override {
    const int pieces = mostTurn_ > 0.0
                           ? std::max(1, static_cast<int>(std::ceil(sweep.turn.norm() / mostTurn_)))
                           : 1;
    btTransform from = toBullet(poseAt(sweep, 0.0));
    for (int piece = 0; piece < pieces; ++piece) {
      const btTransform to = toBullet(poseAt(sweep, static_cast<double>(piece + 1) / pieces));
      const double fraction = cast(from, to);
      if (fraction < 1.0) return {true, (piece + std::max(fraction, 0.0)) / pieces};
      from = to;
    }
    return {false, 1.0};
  }

 protected:
  /// The fraction of the piece at which it hits; 1 or more: it does not.
  virtual double cast(const btTransform& from, const btTransform& to) = 0;
  [[nodiscard]] const btConvexShape& shape() const { return capsule_.shape(); }
  [[nodiscard]] BulletScene::Impl& scene() const { return *scene_; }

 private:
  SharedScene scene_;
  BulletCapsule capsule_;
  double mostTurn_;
};

class BulletSweepTest : public BulletSolver {
 public:
  using BulletSolver::BulletSolver;

 protected:
  double cast(const btTransform& from, const btTransform& to) override {
    btCollisionWorld::ClosestConvexResultCallback closest(from.getOrigin(), to.getOrigin());
    scene().world.convexSweepTest(&shape(), from, to, closest);
    return closest.m_closestHitFraction;
  }
};

/// Casts the capsule against every given triangle and keeps the earliest hit.
class TriangleCast : public btTriangleCallback {
 public:
  TriangleCast(const btConvexShape& shape, const btTransform& from, const btTransform& to)
      : shape_(shape), from_(from), to_(to) {}

  void processTriangle(btVector3* vertices, int /*part*/, int /*index*/) override {
    btTriangleShape triangle(vertices[0], vertices[1], vertices[2]);
    triangle.setMargin(0.0);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btContinuousConvexCollision collision(&shape_, &triangle, &simplex, &penetration);
    btConvexCast::CastResult result;
    result.m_fraction = 1.0;
    if (collision.calcTimeOfImpact(from_, to_, rest_, rest_, result)) {
      earliest_ = std::min<double>(earliest_, result.m_fraction);
    }
  }
  [[nodiscard]] double earliest() const { return earliest_; }

 private:
  const btConvexShape& shape_;
  const btTransform &from_, &to_;
  const btTransform rest_ = btTransform::getIdentity();
  double earliest_ = 1.0;
};

class BulletTriangleCasts : public BulletSolver {
 public:
  using BulletSolver::BulletSolver;

 protected:
  double cast(const btTransform& from, const btTransform& to) override {
    btVector3 speed, spin, low, high;
    btTransformUtil::calculateVelocity(from, to, 1.0, speed, spin);
    shape().calculateTemporalAabb(from, speed, spin, 1.0, low, high);
    TriangleCast triangles(shape(), from, to);
    scene().mesh.shape().processAllTriangles(&triangles, low, high);
    return triangles.earliest();
  }
};

}  // namespace

std::string bulletVersion() {
  return fmt::format("Bullet {}.{:02} (double precision)", btGetVersion() / 100,
                     btGetVersion() % 100);
}

BulletScene::BulletScene(const std::vector<Triangle>& triangles)
    : impl_(std::make_shared<Impl>(triangles)) {}

BulletScene::~BulletScene() = default;

SweepSolvers BulletScene::solvers(const Lss& lss_L) const {
  SweepSolvers solvers;
  for (const double mostTurn : {0.0, kMostTurnOfCast, kFineTurnOfCast}) {
    solvers.push_back(
        std::make_unique<BulletSweepTest>("Bullet convexSweepTest", impl_, lss_L, mostTurn));
  }
  for (const double mostTurn : {0.0, kMostTurnOfCast, kFineTurnOfCast}) {
    solvers.push_back(std::make_unique<BulletTriangleCasts>("Bullet cast of each triangle", impl_,
                                                            lss_L, mostTurn));
  }
  return solvers;
}

}  // namespace foretouch::tools
