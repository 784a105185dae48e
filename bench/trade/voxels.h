// bench/trade/voxels.h: which cells of a regular grid hold a piece of the scene.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "bench/trade/nearest_tree.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

class VoxelGrid {
 public:
  /// Cells of kCellM, larger if the scene's box would need more than kMostCells.
  explicit VoxelGrid(const Scene& scene);

  [[nodiscard]] double cell() const { return cell_; }
  /// Half the diagonal of a cell: no point in it is farther from its middle.
  [[nodiscard]] double halfDiagonal() const { return halfDiagonal_; }

  /// Is the middle of an occupied cell within `reach` of the segment from `a` to `b`?
  [[nodiscard]] bool hasWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reach,
                               TradeWork& work) const;

  static constexpr double kCellM = 0.05;
  static constexpr double kMostCells = 4e6;

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
  [[nodiscard]] Cell cellOf(const Eigen::Vector3d& p) const;
  [[nodiscard]] Eigen::Vector3d middleOf(const Cell& cell) const;
  [[nodiscard]] std::size_t indexOf(const Cell& cell) const;
  void occupy(const Triangle& triangle);

  Eigen::Vector3d low_;
  Cell counts_;
  double cell_ = kCellM, halfDiagonal_ = 0.0;
  std::vector<std::uint8_t> isOccupied_;
};

}  // namespace foretouch::tools
