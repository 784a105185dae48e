// examples/furniture.h: the furniture of the room.
#pragma once

#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// Table, chairs, sofa, coffee table, shelf, lamps, plant; and the tableware on them (tableware.h).
void addFurniture(MeshBuilder& mesh);

}  // namespace foretouch::examples
