// tools/world/served_bodies.h: the world file of a service: the shapes that messages name, and the
// avatars that poses are about.
#pragma once

#include <string>
#include <vector>

#include "network/world_stream/world_setup.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// A body's number in messages: its place in the file, from 1.
[[nodiscard]] constexpr BodyNumber numberInMessages(std::size_t body) {
  return static_cast<BodyNumber>(body) + 1;
}

/// All bodies of the file as shapes; those with an avatar file are avatars. The places that the
/// file gives them do not count: their streams do.
[[nodiscard]] WorldSetup servedBodies(const LoadedWorld& world);

/// What a service does not use of the file, a sentence each.
[[nodiscard]] std::vector<std::string> remarksOnServing(const LoadedWorld& world);

}  // namespace foretouch::tools
