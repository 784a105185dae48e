// lss/hull_volume.h: the volume of a convex hull, from below. Cubic metres.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace foretouch {

/// The points that lie farthest in some of a fixed set of directions (113 pairs over the sphere and
/// the axes), each once; all points where they are no more than those directions. Their hull is
/// that of all points but for what bulges between the directions. O(points).
[[nodiscard]] std::vector<Eigen::Vector3d> extremePoints(
    const std::vector<Eigen::Vector3d>& points);

/// A lower bound, but for rounding, on the volume of the points' convex hull: the hull of
/// extremePoints(). For a finely meshed ball it is 4 % low, for a box exact. 0 where the points lie
/// in a plane. For reports; no promise rests on it.
[[nodiscard]] double hullVolume(const std::vector<Eigen::Vector3d>& points);

}  // namespace foretouch
