// middleware/depth/hull_depth.h: how deep two convex sets are in each other, each the hull of balls
// (points, ends of LSS). Proof: depth.md 6. Metres. Not installed.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace foretouch::internal {

/// The hull of some balls; a radius may be 0.
struct RoundHull {
  std::vector<Eigen::Vector3d> centres;
  std::vector<double> radii;  ///< As many.

  void add(const Eigen::Vector3d& centre, double radius) {
    centres.push_back(centre);
    radii.push_back(radius);
  }
};

struct HullDepth {
  /// No translation shorter than this one parts them; 0: nothing is proven.
  double lower = 0.0;
  /// A translation of `one` along nhat that is this long does; 0: a plane across nhat parts them.
  double upper = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< Not longer than 1; from `other` to `one`.
};

/// upper - lower is about kHullDepthGap of the extent, where their difference has a volume and few
/// hundred looks suffice. `rounding`: no point of either is farther from where it is given (m, >=
/// 0). All coordinates finite, below 1e100; none of the two is empty. Each look is O(balls).
inline constexpr double kHullDepthGap = 1e-9;
[[nodiscard]] HullDepth depthOf(const RoundHull& one, const RoundHull& other, double rounding);

}  // namespace foretouch::internal
