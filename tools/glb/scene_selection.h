// tools/glb/scene_selection.h: which triangles of a scene to show if there are too many.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// At most `most` triangles, in ascending order: those whose box is nearest to one of `places`; of
/// equally near ones, the first. Includes `always`, as far as they fit. Skips triangles that were
/// not finite in the file. Precondition: at least one place. O(triangles * places).
[[nodiscard]] std::vector<TriangleId> nearestTriangles(const Scene& scene,
                                                       const std::vector<Eigen::Vector3d>& places,
                                                       std::vector<TriangleId> always,
                                                       std::size_t most);

}  // namespace foretouch::tools
