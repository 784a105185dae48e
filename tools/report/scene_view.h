// tools/report/scene_view.h: a scene as a browser can show it: all of it where that is light
// enough, else all of it simplified as long as that hides next to nothing, else what is near the
// action, simplified where it must be. Metres, world W.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "middleware/scene/scene.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

inline constexpr std::size_t kDefaultViewTriangles = 150'000;
inline constexpr std::size_t kMostTimesTooHeavy = 8;

struct SceneRequest {
  std::string name;
  std::size_t maxTriangles = kDefaultViewTriangles;
  Eigen::AlignedBox3d action;         ///< Around all that moves; empty: nothing does.
  std::vector<TriangleId> contacted;  ///< Always shown as they are; any order, repetitions too.
  /// Details this small (m) are rather hidden than anything left out.
  double harmlessM = 2e-3;
};

/// Adds a sentence to `notes` for what was left out or simplified. At most maxTriangles and those
/// contacted are shown. Time: O(n log n), n the triangles of the scene;
/// memory: O(those within reach), or O(n) where all of it is simplified, which is tried up to
/// kMostTimesTooHeavy times maxTriangles.
[[nodiscard]] ViewScene viewOf(const Scene& scene, const SceneRequest& request,
                               std::vector<std::string>& notes);

}  // namespace foretouch::tools
