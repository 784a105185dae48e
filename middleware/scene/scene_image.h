// middleware/scene/scene_image.h: a Scene out of arrays that were kept, in memory or in a
// file's pages (assets/scene/scene_file.h). Not installed.
#pragma once

#include <memory>

#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {

/// A scene of these parts, which may be a stranger's: their numbers are within what queries ask of
/// them, the tree has one way to each triangle, and no walk leads out of the arrays. Whether the
/// boxes on that way hold the triangle, holdsItsTriangles() says. O(n), in the order of memory.
/// Errors: OutOfRange, Mismatch.
[[nodiscard]] Result<Scene> sceneOf(std::shared_ptr<SceneParts> parts);

/// All of what build() would make, but for the choice of the tree: each triangle's vertices are in
/// order, its leaf has them rounded to nearest, and boxes and balls hold them. O(n).
[[nodiscard]] Result<Done> holdsItsTriangles(const Scene& scene);

}  // namespace foretouch::internal
