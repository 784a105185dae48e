// middleware/scene/scene_parts.h: the contents of a Scene. Not installed.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "middleware/scene/culler.h"
#include "middleware/scene/flat_bvh.h"
#include "middleware/scene/point_query_culler.h"
#include "middleware/scene/raw_scene.h"

namespace foretouch::internal {

struct SceneParts {
  std::vector<Triangle> triangles;  // vertices sorted; dropped ones unchanged
  std::vector<ObjectId> objectOf;
  std::vector<std::string> objectNames;
  SceneAudit audit;
  std::vector<TriangleId> finiteIds;  // ascending
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  FlatBvh bvh;

  /// Builds the reference scene on first use: most programs never need it.
  [[nodiscard]] Result<const PointQueryCuller*> pointQueryCuller() const;

 private:
  mutable std::mutex mutex_;
  mutable std::unique_ptr<PointQueryCuller> pointQueryCuller_;
};

}  // namespace foretouch::internal
