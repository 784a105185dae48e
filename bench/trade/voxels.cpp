#include "bench/trade/voxels.h"

#include <algorithm>
#include <cmath>

#include "lss/segment_triangle.h"

namespace foretouch::tools {
namespace {

/// Covers the rounding of middles and distances.
constexpr double kRounding = 1.0 + 1e-9;

double distanceOf(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double square = along.squaredNorm();
  const double s = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + s * along - p).norm();
}

}  // namespace

VoxelGrid::VoxelGrid(const Scene& scene) {
  const SceneAudit& audit = scene.audit();
  low_ = audit.boxMin;
  const Eigen::Vector3d size = audit.boxMax - audit.boxMin;
  const auto cellsOf = [&](double cell) {
    return ((size / cell).array().floor() + 1.0).matrix().eval();
  };
  constexpr double kCoarser = 1.25;
  while (cellsOf(cell_).prod() > kMostCells) cell_ *= kCoarser;
  counts_ = cellsOf(cell_).cast<std::int64_t>();
  halfDiagonal_ = 0.5 * std::sqrt(3.0) * cell_ * kRounding;
  isOccupied_.assign(static_cast<std::size_t>(counts_.prod()), 0);
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    const Triangle& triangle = scene.triangle(static_cast<TriangleId>(i));
    if (isFinite(triangle)) occupy(triangle);
  }
}

VoxelGrid::Cell VoxelGrid::cellOf(const Eigen::Vector3d& p) const {
  Cell cell;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double place = std::floor((p[axis] - low_[axis]) / cell_);
    cell[axis] =
        static_cast<std::int64_t>(std::clamp(place, 0.0, static_cast<double>(counts_[axis] - 1)));
  }
  return cell;
}

Eigen::Vector3d VoxelGrid::middleOf(const Cell& cell) const {
  return low_ + cell_ * (cell.cast<double>().array() + 0.5).matrix();
}

std::size_t VoxelGrid::indexOf(const Cell& cell) const {
  return static_cast<std::size_t>((cell.z() * counts_.y() + cell.y()) * counts_.x() + cell.x());
}

void VoxelGrid::occupy(const Triangle& triangle) {
  const auto& v = triangle.vertices;
  const Cell low = cellOf(v[0].cwiseMin(v[1]).cwiseMin(v[2]));
  const Cell high = cellOf(v[0].cwiseMax(v[1]).cwiseMax(v[2]));
  Cell cell;
  for (cell.z() = low.z(); cell.z() <= high.z(); ++cell.z()) {
    for (cell.y() = low.y(); cell.y() <= high.y(); ++cell.y()) {
      for (cell.x() = low.x(); cell.x() <= high.x(); ++cell.x()) {
        const Eigen::Vector3d middle = middleOf(cell);
        if (closestPoints(middle, middle, triangle).distance <= halfDiagonal_) {
          isOccupied_[indexOf(cell)] = 1;
        }
      }
    }
  }
}

bool VoxelGrid::hasWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reach,
                          TradeWork& work) const {
  const Eigen::Vector3d grown = Eigen::Vector3d::Constant(reach);
  const Eigen::Vector3d lowest = a.cwiseMin(b) - grown, highest = a.cwiseMax(b) + grown;
  const Eigen::Vector3d top = low_ + cell_ * counts_.cast<double>();
  if ((lowest.array() > top.array()).any() || (highest.array() < low_.array()).any()) return false;
  const Cell low = cellOf(lowest), high = cellOf(highest);
  Cell cell;
  for (cell.z() = low.z(); cell.z() <= high.z(); ++cell.z()) {
    for (cell.y() = low.y(); cell.y() <= high.y(); ++cell.y()) {
      for (cell.x() = low.x(); cell.x() <= high.x(); ++cell.x()) {
        ++work.nodes;
        if (isOccupied_[indexOf(cell)] == 0) continue;
        ++work.pairs;
        if (distanceOf(middleOf(cell), a, b) <= reach) return true;
      }
    }
  }
  return false;
}

}  // namespace foretouch::tools
