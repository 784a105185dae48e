#include "judge/winding.h"

#include <cmath>

namespace foretouch::oracle {

Real windingOf(const Vec3r& p, const std::vector<Corners<Real>>& surface) {
  Real sum = 0;
  for (const Corners<Real>& triangle : surface) {
    const Vec3r a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
    const Real x = norm(a), y = norm(b), z = norm(c);
    const Real volume = dot(a, cross(b, c));
    const Real down = x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y;
    sum += 2 * std::atan2(volume, down);
  }
  return sum / (4 * 3.14159265358979323846L);
}

}  // namespace foretouch::oracle
