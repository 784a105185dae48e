#include "middleware/pair/skin_sweep.h"

#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

Aabb boxOf(const MovingHull& moving) {
  Aabb box;
  for (const Eigen::Vector3d& v : moving.hull.points) box.add(v);
  return box;
}

double largest(const std::array<double, 3>& values) {
  return *std::max_element(values.begin(), values.end());
}

}  // namespace

void sweepSkin(const Side& parts, const std::vector<std::vector<LinkState>>& nodes,
               const Pieces& pieces, double margin, std::vector<Aabb>& starts,
               std::vector<Aabb>& boxes) {
  const std::int32_t numTriangles = parts.skin->numTriangles(parts.link);
  const auto count = countOf(pieces.count);
  starts.assign(static_cast<std::size_t>(numTriangles), Aabb{});
  boxes.assign(static_cast<std::size_t>(numTriangles) * count, Aabb{});
  PosedLink posed;
  for (int k = 0; k <= pieces.count; ++k) {
    posed.all = &nodes[slotOf(k)];
    // Pieces are equal up to a rounding of their boundaries, which the inflation covers.
    const double sagitta = 1.0 / (8.0 * static_cast<double>(count) * static_cast<double>(count));
    for (std::int32_t i = 0; i < numTriangles; ++i) {
      const MovingHull moving = parts.hullOf(0, Part::of(HierarchyChild::triangle(i)), posed);
      const Aabb corners = boxOf(moving);
      const double rounding = largest(moving.positionRounding) + margin;
      if (k == 0) {
        starts[slotOf(i)] = corners;
        starts[slotOf(i)].grow(rounding * kInflation);
      }
      Aabb reached = corners;
      reached.grow((largest(moving.acceleration) * sagitta + rounding) * kInflation);
      // The hull of a piece's two ends, each grown, contains what is between them.
      const std::size_t first = slotOf(i) * count;
      if (k > 0) boxes[first + slotOf(k) - 1].add(reached);
      if (k < pieces.count) boxes[first + slotOf(k)].add(reached);
    }
  }
}

}  // namespace foretouch::internal
