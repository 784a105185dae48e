// examples/furniture.h: what stands and hangs in the room.
#pragma once

#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// Table, chairs, sofa, coffee table, shelf, lamps, plant; and what lies on them (tableware.h).
void addFurniture(MeshBuilder& mesh);

}  // namespace foretouch::examples
