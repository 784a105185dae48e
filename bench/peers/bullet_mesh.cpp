#include "bench/peers/bullet_mesh.h"

namespace foretouch::tools {

BulletMesh::BulletMesh(const std::vector<Triangle>& triangles) {
  for (const Triangle& triangle : triangles) {
    for (const Eigen::Vector3d& v : triangle.vertices) {
      indices_.push_back(static_cast<int>(vertices_.size()));
      vertices_.push_back(toBullet(v));
    }
  }
  btIndexedMesh part;
  part.m_numTriangles = static_cast<int>(triangles.size());
  part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data());
  part.m_triangleIndexStride = 3 * sizeof(int);
  part.m_numVertices = static_cast<int>(vertices_.size());
  part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_.data());
  part.m_vertexStride = sizeof(btVector3);
  mesh_.addIndexedMesh(part);
  const bool quantizedBoxes = true;  // the tree that Bullet recommends
  shape_ = std::make_unique<btBvhTriangleMeshShape>(&mesh_, quantizedBoxes);
  shape_->setMargin(0.0);
}

}  // namespace foretouch::tools
