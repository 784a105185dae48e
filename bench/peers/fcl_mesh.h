// bench/peers/fcl_mesh.h: triangles as FCL's own mesh. Knows FCL's types: only for the sources of
// the peers.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <memory>
#include <vector>

#include "lss/lss.h"

namespace foretouch::tools {

/// Boxes for collision and rectangle swept spheres for distance: FCL's own recommendation.
using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

[[nodiscard]] inline std::shared_ptr<FclMesh> fclMeshOf(const std::vector<Triangle>& triangles) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> corners;
  for (const Triangle& triangle : triangles) {
    const std::size_t first = vertices.size();
    for (const Eigen::Vector3d& v : triangle.vertices) vertices.push_back(v);
    corners.emplace_back(first, first + 1, first + 2);
  }
  auto mesh = std::make_shared<FclMesh>();
  mesh->beginModel(static_cast<int>(corners.size()), static_cast<int>(vertices.size()));
  mesh->addSubModel(vertices, corners);
  mesh->endModel();
  return mesh;
}

}  // namespace foretouch::tools
