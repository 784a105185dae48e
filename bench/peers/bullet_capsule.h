// bench/peers/bullet_capsule.h: an LSS as Bullet's own shape. Knows Bullet's types: only for the
// sources of the peers.
#pragma once

#include <array>
#include <btBulletCollisionCommon.h>

#include "bench/peers/bullet_mesh.h"
#include "lss/lss.h"

namespace foretouch::tools {

/// Bullet clips the turn of one cast at 45 degrees (ANGULAR_MOTION_THRESHOLD): a motion that turns
/// further must be cut, or it ends in a wrong pose.
inline constexpr double kMostTurnOfCast = 0.78;

/// A capsule anywhere in the link's frame: Bullet turns a shape about its origin, which must be the
/// pivot. The margin is the radius, so that its GJK works on the bare axis.
class BulletCapsule {
 public:
  explicit BulletCapsule(const Lss& lss_L)
      : ends_{toBullet(lss_L.a), toBullet(lss_L.b)},
        radii_{lss_L.radius, lss_L.radius},
        shape_(ends_.data(), radii_.data(), 2) {
    shape_.setMargin(lss_L.radius);
  }
  [[nodiscard]] const btConvexShape& shape() const { return shape_; }

 private:
  std::array<btVector3, 2> ends_;
  std::array<btScalar, 2> radii_;
  btMultiSphereShape shape_;
};

}  // namespace foretouch::tools
