// assets/import/polygon.h: faces of more than three corners as triangles. Not installed.
//
// Done here and not by the model reader: assimp 5.2.5 drops the rest of a polygon once it finds no
// further ear (a hexagon out of plane came back as two triangles of four), and a missing surface is
// a missed contact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace foretouch::internal {

using CornerTriple = std::array<std::uint32_t, 3>;

/// Appends exactly n - 2 triangles for n >= 3 corners, as positions in `corners`, whatever the
/// corners are. Cuts ears off in the plane of the polygon's mean normal, which covers a simple
/// polygon exactly, and a convex one by a fan from its first corner. If no ear is left (crossing
/// edges, no plane, not finite), it still cuts corners off: the signed triangles still sum to the
/// polygon, so they cover every point that it winds around, perhaps more.
void cutPolygon(const std::vector<Eigen::Vector3d>& corners, std::vector<CornerTriple>& triangles);

}  // namespace foretouch::internal
