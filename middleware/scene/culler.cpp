#include "middleware/scene/culler.h"

#include <cmath>
#include <limits>

namespace foretouch::internal {

float floatBelow(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafterf(f, -std::numeric_limits<float>::infinity())
                                    : f;
}

float floatAbove(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafterf(f, std::numeric_limits<float>::infinity())
                                    : f;
}

Aabb boxOf(const Triangle& triangle) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : triangle.vertices) box.add(vertex);
  return box;
}

}  // namespace foretouch::internal
