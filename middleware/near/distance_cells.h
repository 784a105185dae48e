// middleware/near/distance_cells.h: how far a scene is from the centres of cells, and what is
// nearest, found out when it is first asked for: a bound on the distance of any place without a
// walk. Metres, from the scene's origin. Not installed.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// Any number of threads may ask: each that finds a cell out finds the same.
class DistanceCells {
 public:
  /// Along each axis; eight bytes per cell, once there was a question.
  static constexpr int kAcross = 64;

  /// `box`: where questions are expected; beyond it bounds are weaker.
  DistanceCells(Scene scene, const Eigen::AlignedBox3d& box);

  struct Near {
    double below;         ///< No triangle is nearer. Rounded down.
    TriangleId triangle;  ///< One that is nearest to the centre of the cell.
  };
  [[nodiscard]] Near near(const Eigen::Vector3d& p) const;
  /// The longest way across a cell: a bound is weaker than the truth by no more, in the box.
  [[nodiscard]] double diagonal() const { return size_.norm(); }

 private:
  struct alignas(8) Cell {  // or clang calls a library for each load
    float distance = -1.0F;
    TriangleId triangle = -1;  ///< Not known yet.
  };
  [[nodiscard]] Cell cellAround(const Eigen::Vector3d& centre) const;

  Scene scene_;
  Eigen::Vector3d low_, size_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<std::atomic<Cell>[]> cells_;
};

}  // namespace foretouch::internal
