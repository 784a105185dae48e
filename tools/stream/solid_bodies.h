// tools/stream/solid_bodies.h: which bodies of a served world are solid, and how.
#pragma once

#include "articulated/result.h"
#include "network/world_stream/world_setup.h"
#include "tools/settings/stream_settings.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Makes the avatars solid whose names --world-solid has, if --solid asks for it. `query`: what is
/// ignored does not stop them. Errors name the option, or the file and the line: a name that is not
/// an avatar's; an avatar that the file has carried, or carry something, which no solid body of a
/// service does.
[[nodiscard]] Result<Done> makeSolidBodies(const LoadedWorld& world, const WorldRequest& query,
                                           const StreamSolidRequest& request, WorldSetup& setup);

}  // namespace foretouch::tools
