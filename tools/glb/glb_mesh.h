// tools/glb/glb_mesh.h: triangles as a GLB holds them, in floats. Metres.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/lss.h"
#include "lss/triangle.h"

namespace foretouch::tools {

struct GlbMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  ///< One a position, unit; or none: faces are flat then.
  std::vector<std::uint32_t> indices;    ///< Three a triangle.

  [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

/// The triangles less `origin`, rounded; vertices at one place become one. O(n log n).
[[nodiscard]] GlbMesh meshOf(const std::vector<Triangle>& triangles,
                             const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Adds the LSS's surface, smooth; its vertices are on it to rounding.
void appendLss(const Lss& lss, GlbMesh& mesh);
/// How many triangles that adds.
[[nodiscard]] std::size_t trianglesOfLss();

/// A ball about the origin and an arrow from it along +Y, `length` long.
[[nodiscard]] GlbMesh markerMesh(double length);

}  // namespace foretouch::tools
