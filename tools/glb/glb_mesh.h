// tools/glb/glb_mesh.h: triangles in a GLB's form, in floats. Metres.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/lss.h"

namespace foretouch::tools {

struct GlbMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  ///< One per position, unit; or none: flat faces.
  std::vector<std::uint32_t> indices;    ///< Three per triangle.

  [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

/// The triangles less `origin`, rounded; merges vertices at one place. O(n log n).
[[nodiscard]] GlbMesh meshOf(const std::vector<Triangle>& triangles,
                             const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Adds the LSS's surface, smooth; its vertices are on it to rounding.
void appendLss(const Lss& lss, GlbMesh& mesh);
/// The number of triangles that this adds.
[[nodiscard]] std::size_t trianglesOfLss();

/// A ball about the origin and an arrow from it along +Y, `length` long.
[[nodiscard]] GlbMesh markerMesh(double length);

}  // namespace foretouch::tools
