// examples/tableware.h: plates, cups and vases: surfaces of revolution.
#pragma once

#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// Tableware for four; the table's top is the plane y = 0 of `top`, 1.7 m along x, 0.9 m along z.
void addTableware(MeshBuilder& mesh, const Eigen::Isometry3d& top);

/// A vase on y = 0 of `frame`.
void addVase(MeshBuilder& mesh, const std::string& name, const Eigen::Isometry3d& frame,
             double height);

}  // namespace foretouch::examples
