// Bullet's questions to a world that stands still.
#include <btBulletCollisionCommon.h>

#include "bench/peers/bullet_mesh.h"
#include "bench/peers/peer_solvers.h"

namespace foretouch::tools {

/// Members in the order of their dependencies.
struct BulletCasts::Impl {
  explicit Impl(const std::vector<Triangle>& triangles) : mesh(triangles) {
    still.setCollisionShape(&mesh.shape());
    world.addCollisionObject(&still);
  }
  BulletMesh mesh;
  btCollisionObject still;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

BulletCasts::BulletCasts(const std::vector<Triangle>& triangles)
    : impl_(std::make_unique<Impl>(triangles)) {}
BulletCasts::~BulletCasts() = default;

std::optional<double> BulletCasts::first(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                         double radius) const {
  const btVector3 begin = toBullet(from), end = toBullet(to);
  if (radius == 0.0) {
    btCollisionWorld::ClosestRayResultCallback ray(begin, end);
    impl_->world.rayTest(begin, end, ray);
    if (!ray.hasHit()) return std::nullopt;
    return ray.m_closestHitFraction;
  }
  const btSphereShape sphere(radius);
  btCollisionWorld::ClosestConvexResultCallback cast(begin, end);
  const btQuaternion none = btQuaternion::getIdentity();
  impl_->world.convexSweepTest(&sphere, btTransform(none, begin), btTransform(none, end), cast);
  if (!cast.hasHit()) return std::nullopt;
  return cast.m_closestHitFraction;
}

}  // namespace foretouch::tools
