// tools/report/scene_view.h: a scene that a browser can show: all of it if it is light enough, else
// all of it simplified if that hides next to nothing, else the part near the action, simplified if
// needed. Metres, world W.
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
  Eigen::AlignedBox3d action;         ///< Box around everything that moves; empty: nothing does.
  std::vector<TriangleId> contacted;  ///< Always shown unchanged; any order, repetitions too.
  /// Prefers hiding details this small (m) to omitting triangles.
  double harmlessM = 2e-3;
};

/// Adds a sentence to `notes` if it omits or simplifies. Shows at most maxTriangles and those
/// contacted. Time: O(n log n), n the triangles of the scene; memory: O(those within reach), or
/// O(n) to simplify all of it, which it tries up to kMostTimesTooHeavy times maxTriangles.
[[nodiscard]] ViewScene viewOf(const Scene& scene, const SceneRequest& request,
                               std::vector<std::string>& notes);

}  // namespace foretouch::tools
