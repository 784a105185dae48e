// bench/peers/bullet_mesh.h: triangles as Bullet's own mesh shape, and places as its
// transforms. Knows Bullet's types: only for
// the sources of the peers.
#pragma once

#include <btBulletCollisionCommon.h>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "bench/peers/rigid_sweep.h"
#include "lss/lss.h"

namespace foretouch::tools {

inline btVector3 toBullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
inline btQuaternion toBullet(const Quaternion& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
inline btTransform toBullet(const RigidPose& pose) {
  return btTransform(toBullet(pose.rotation), toBullet(pose.pivot));
}

/// Members in the order of their dependencies.
class BulletMesh {
 public:
  explicit BulletMesh(const std::vector<Triangle>& triangles);
  BulletMesh(const BulletMesh&) = delete;
  BulletMesh& operator=(const BulletMesh&) = delete;

  [[nodiscard]] btBvhTriangleMeshShape& shape() const { return *shape_; }

 private:
  std::vector<btVector3> vertices_;
  std::vector<int> indices_;
  btTriangleIndexVertexArray mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

}  // namespace foretouch::tools
