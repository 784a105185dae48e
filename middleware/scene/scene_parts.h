// middleware/scene/scene_parts.h: the contents of a Scene. Not installed.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "middleware/scene/flat_bvh.h"
#include "middleware/scene/flat_edges.h"
#include "middleware/scene/raw_scene.h"
#include "tessellation/open_edges.h"

namespace foretouch::internal {

struct SceneParts {
  std::vector<Triangle> triangles;  // vertices sorted; dropped ones unchanged
  std::vector<ObjectId> objectOf;
  std::vector<std::string> objectNames;
  SceneAudit audit;
  std::vector<TriangleId> finiteIds;  // ascending
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  FlatBvh bvh;

  /// Builds them on first use.
  [[nodiscard]] const FlatEdges& flatEdges() const;
  /// One per object; likewise.
  [[nodiscard]] const std::vector<ObjectRoom>& rooms() const;

 private:
  mutable std::mutex mutex_;
  mutable std::unique_ptr<FlatEdges> flatEdges_;
  mutable std::unique_ptr<std::vector<ObjectRoom>> rooms_;
};

}  // namespace foretouch::internal
