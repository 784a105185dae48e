#include "middleware/exact/ray_up.h"

#include <cstddef>

#include "middleware/exact/side_of.h"

namespace foretouch::internal {
namespace {

/// The turn to the point moved aside: never 0, unless a and b are one as seen from above.
int turnBeside(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p) {
  const int turn = turnOf(a, b, p);
  if (turn != 0) return turn;
  // The turn's derivatives: by p's x, a.y - b.y; by its y, b.x - a.x.
  if (a.y() != b.y()) return a.y() > b.y() ? 1 : -1;
  if (a.x() != b.x()) return b.x() > a.x() ? 1 : -1;
  return 0;
}

}  // namespace

RayUp rayUp(const Eigen::Vector3d& p, const Triangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const int turn = turnBeside(a, b, p);
  if (turn == 0 || turn != turnBeside(b, c, p) || turn != turnBeside(c, a, p)) {
    return RayUp::Misses;  // a triangle that is seen as a line has no inside
  }
  const int side = sideOf(a, b, c, p) * turn;  // above 0: p is above the plane
  if (side == 0) return RayUp::Touches;
  return side < 0 ? RayUp::Crosses : RayUp::Misses;
}

}  // namespace foretouch::internal
