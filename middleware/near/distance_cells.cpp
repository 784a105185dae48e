#include "middleware/near/distance_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"
#include "middleware/scene/eight_boxes.h"
#include "middleware/scene/nearest_walk.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kCells =
    std::size_t{DistanceCells::kAcross} * DistanceCells::kAcross * DistanceCells::kAcross;
/// A cell is at least so long (m), that all of them differ.
constexpr double kLeastCell = 1e-6;

/// The nearest triangle to a point; bounds are squares.
class NearestToPoint {
 public:
  NearestToPoint(const SceneParts& scene, const Vector3d& p)
      : scene_(scene),
        p_(p),
        rounding_((p - p.cast<float>().cast<double>()).norm() +
                  4.0 * kUnitRoundoff * scene.origin.lpNorm<1>()) {
    for (int axis = 0; axis < 3; ++axis) {
      point_.lower[axis] = point_.upper[axis] = static_cast<float>(p[axis]);
    }
  }

  [[nodiscard]] double nearest() const { return nearest_; }
  [[nodiscard]] TriangleId triangle() const { return triangle_; }
  [[nodiscard]] double limit() const {
    const double limit = std::min(nearest_, kFarthest) + rounding_;
    return limit * limit * kSquare;
  }
  void bounds(const BvhNode& node, double (&bounds)[kBvhWidth]) const {
    float squares[kBvhWidth];
    squaredGaps(node.lower, node.upper, point_, squares);
    for (int i = 0; i < kBvhWidth; ++i) bounds[i] = static_cast<double>(squares[i]);
  }
  void leaf(const BvhLeaf& leaf) {
    for (int i = 0; i < kBvhWidth && leaf.id[i] >= 0; ++i) {
      Hull triangle = Hull::of(scene_.triangles[slotOf(leaf.id[i])]);
      for (Vector3d& v : triangle.points) v -= scene_.origin;
      const double distance = separation(Hull::segment(p_, p_), triangle).lower();
      if (distance < nearest_) triangle_ = leaf.id[i];
      nearest_ = std::min(nearest_, distance);
    }
  }
  [[nodiscard]] double rounding() const { return rounding_; }

 private:
  static constexpr double kFarthest = 1e100, kSquare = 1.0 + 1e-5;

  const SceneParts& scene_;
  const Vector3d p_;
  LocalBox point_;
  const double rounding_;
  double nearest_ = std::numeric_limits<double>::infinity();
  TriangleId triangle_ = -1;
};

}  // namespace

DistanceCells::DistanceCells(Scene scene, const Eigen::AlignedBox3d& box)
    : scene_(std::move(scene)),
      low_(box.min()),
      size_((box.sizes() / kAcross).cwiseMax(kLeastCell)) {}

DistanceCells::Near DistanceCells::near(const Vector3d& p) const {
  std::call_once(once_, [this] {
    cells_ = std::make_unique<std::atomic<Cell>[]>(kCells);
    for (std::size_t i = 0; i < kCells; ++i) cells_[i].store(Cell(), std::memory_order_relaxed);
  });
  Vector3d centre;
  std::size_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = (p[axis] - low_[axis]) / size_[axis];
    const int index = along > 0.0 ? static_cast<int>(std::min(along, kAcross - 1.0)) : 0;
    centre[axis] = low_[axis] + (index + 0.5) * size_[axis];
    place = place * kAcross + slotOf(index);
  }
  Cell cell = cells_[place].load(std::memory_order_relaxed);
  if (cell.triangle < 0) {
    cell = cellAround(centre);
    cells_[place].store(cell, std::memory_order_relaxed);
  }
  return {static_cast<double>(cell.distance) - kInflation * (p - centre).norm(), cell.triangle};
}

DistanceCells::Cell DistanceCells::cellAround(const Vector3d& centre) const {
  NearestToPoint search(scene_.parts(), centre);
  walkNearestFirst(scene_.parts().bvh, search);
  return {floatBelow(search.nearest() - search.rounding()), search.triangle()};
}

}  // namespace foretouch::internal
