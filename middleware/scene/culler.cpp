#include "middleware/scene/culler.h"

namespace foretouch::internal {

Aabb boxOf(const Triangle& triangle) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : triangle.vertices) box.add(vertex);
  return box;
}

}  // namespace foretouch::internal
