// tessellation/aabb.h: an axis-aligned box in the world W. Metres. Not installed.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "lss/rounding.h"

namespace foretouch {

struct Aabb {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  /// Empty until the first add().
  Eigen::Vector3d min = Eigen::Vector3d::Constant(kInfinity);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-kInfinity);

  void add(const Eigen::Vector3d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  void add(const Aabb& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }
  /// Moves every face outward by at least `distance` (>= 0), rounding included: the difference
  /// rounds by half a unit in the last place of at most |face| + distance, and we add four of
  /// these.
  void grow(double distance) {
    constexpr double kRounding = 4.0 * kUnitRoundoff;
    for (int i = 0; i < 3; ++i) {
      min[i] -= distance + kRounding * (std::abs(min[i]) + distance);
      max[i] += distance + kRounding * (std::abs(max[i]) + distance);
    }
  }
  /// Closed boxes: touching counts.
  [[nodiscard]] bool overlaps(const Aabb& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  /// 0 if they overlap, else the distance of the nearest points, as rounded.
  [[nodiscard]] double distance(const Aabb& other) const {
    const Eigen::Vector3d apart = (other.min - max).cwiseMax(min - other.max).cwiseMax(0.0);
    return apart.norm();
  }
  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const {
    return (min.array() <= point.array()).all() && (point.array() <= max.array()).all();
  }
};

}  // namespace foretouch
