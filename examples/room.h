// examples/room.h: the shell of the room: floor, walls, openings, stairs, things that hang.
#pragma once

#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// x in [-3.5, 3.5], z in [-3, 3], walls to y = 2.7, the floor's top at y = 0. No ceiling, so that
/// a viewer can look into the room.
inline constexpr double kHalfWidth = 3.5;
inline constexpr double kHalfDepth = 3.0;
inline constexpr double kWallHeight = 2.7;

void addRoom(MeshBuilder& mesh);

}  // namespace foretouch::examples
