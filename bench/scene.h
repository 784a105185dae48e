// bench/scene.h: the same surface in more triangles.
#pragma once

#include <cstddef>

#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Halves the triangle with the longest edge at that edge's middle until there are `count`: big
/// triangles first, so that density evens out, as in a finer scan of the same place. The surface
/// stays the same up to rounding; neighbours may meet in T-junctions. Scenes that have as many
/// already, or only edges too short to halve, stay as they are. Leaves triangles that are not
/// finite alone. O(count log count), the same result on every run.
[[nodiscard]] RawScene subdivided(RawScene scene, std::size_t count);

}  // namespace foretouch::tools
