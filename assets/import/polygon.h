// assets/import/polygon.h: faces of more than three corners as triangles. Not installed.
//
// Done here and not by the model reader: assimp 5.2.5 drops what is left of a polygon once it finds
// no further ear (a hexagon out of plane came back as two triangles of four), and a surface that is
// missing is a contact that is missed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace foretouch::internal {

using CornerTriple = std::array<std::uint32_t, 3>;

/// Appends exactly n - 2 triangles for n >= 3 corners, as positions in `corners`, whatever the
/// corners are. Ears are cut off in the plane of the polygon's mean normal, so a simple polygon is
/// covered exactly, a convex one by a fan from its first corner. Where no ear is left (crossing
/// edges, no plane, not finite) corners are cut off all the same: the signed triangles still sum to
/// the polygon, so every point it winds around stays covered; more may be.
void cutPolygon(const std::vector<Eigen::Vector3d>& corners, std::vector<CornerTriple>& triangles);

}  // namespace foretouch::internal
