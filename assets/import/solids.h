// assets/import/solids.h: the solids that robots' files describe by their sizes, as triangles. In
// foretouch-import only. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace foretouch::internal {

/// Triangles in one frame.
struct FlatMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The box about its centre, twelve triangles.
[[nodiscard]] FlatMesh boxOf(const Eigen::Vector3d& size);

/// A prism about the z axis and its centre that contains the cylinder of that radius and length,
/// rounding included: its 32 sides touch it, so its edges stand off by half a percent of the
/// radius.
[[nodiscard]] FlatMesh cylinderAround(double radius, double length);

/// A polyhedron about the centre that contains the ellipsoid of these semi-axes, rounding included:
/// its 512 sides touch it, and its corners stand off by less than three percent.
[[nodiscard]] FlatMesh ellipsoidAround(const Eigen::Vector3d& semiAxes);

}  // namespace foretouch::internal
