// tools/glb/world_glb.h: a replayed world as one animated GLB: the scene, all bodies in their
// in-between motion, triggers as outlines, and where touches begin (docs/formats.md, "A world as
// GLB").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/glb/avatar_animation.h"
#include "tools/glb/glb_content.h"
#include "tools/glb/replay_glb.h"
#include "tools/world/world_touches.h"

namespace foretouch::tools {

/// `touches`: after finish(). `header`: the results' first line. Writes the file; returns what it
/// leaves out, one sentence each. Errors: an unwritable file, times that floats cannot distinguish,
/// more than a GLB can hold.
[[nodiscard]] Result<std::vector<std::string>> writeWorldGlb(const LoadedWorld& world,
                                                             const WorldTouches& touches,
                                                             const std::string& header,
                                                             const GlbRequest& request);

}  // namespace foretouch::tools
