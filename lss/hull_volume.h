// lss/hull_volume.h: a lower bound on the volume of a convex hull. Cubic metres. Not installed.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace foretouch {

/// The points that lie farthest in some of a fixed set of directions (113 pairs over the sphere and
/// the axes), each once; all points if there are no more than those directions. Their hull misses
/// only the bulges of the full hull between the directions. O(points).
[[nodiscard]] std::vector<Eigen::Vector3d> extremePoints(
    const std::vector<Eigen::Vector3d>& points);

/// A lower bound, but for rounding, on the volume of the points' convex hull: the hull of
/// extremePoints(). 4 % low for a finely meshed ball, exact for a box. 0 if the points lie in a
/// plane. For reports; no promise rests on it.
[[nodiscard]] double hullVolume(const std::vector<Eigen::Vector3d>& points);

}  // namespace foretouch
