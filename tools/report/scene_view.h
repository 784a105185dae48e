// tools/report/scene_view.h: a scene as a browser can show it: all of it where that is light
// enough, else what is near the action, else a simplified form of that. Metres, world W.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "middleware/scene.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

inline constexpr std::size_t kDefaultViewTriangles = 150'000;

struct SceneRequest {
  std::string name;
  std::size_t maxTriangles = kDefaultViewTriangles;
  Eigen::AlignedBox3d action;         ///< Around all that moves; empty: nothing does.
  std::vector<TriangleId> contacted;  ///< Always shown as they are; any order, repetitions too.
};

/// Adds a sentence to `notes` for what was left out or simplified. At most maxTriangles and those
/// contacted are shown. Time: O(n), n the triangles of the scene; memory: O(those within reach).
[[nodiscard]] ViewScene viewOf(const Scene& scene, const SceneRequest& request,
                               std::vector<std::string>& notes);

}  // namespace foretouch::tools
