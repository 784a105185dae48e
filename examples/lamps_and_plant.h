// examples/lamps_and_plant.h: the thin things: stems, cords, shades without thickness, leaves.
#pragma once

#include <string>

#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// A lamp that stands on y = 0 of `frame`: a stem of 5 mm radius, 48 cm high with its shade.
void addTableLamp(MeshBuilder& mesh, const Eigen::Isometry3d& frame);

/// A lamp that stands on y = 0 of `frame`: a pole of 11 mm radius, 1.75 m high with its shade.
void addFloorLamp(MeshBuilder& mesh, const Eigen::Isometry3d& frame);

/// A lamp that hangs from y = 0 of `frame` on a cord of 3 mm radius, 1.05 m long.
void addPendantLamp(MeshBuilder& mesh, const std::string& suffix, const Eigen::Isometry3d& frame);

/// A pot with stems and drooping leaves without thickness, about 1.6 m high.
void addPlant(MeshBuilder& mesh, const Eigen::Isometry3d& frame);

}  // namespace foretouch::examples
