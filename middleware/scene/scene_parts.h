// middleware/scene/scene_parts.h: the contents of a Scene. Not installed.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "middleware/scene/flat_bvh.h"
#include "middleware/scene/flat_edges.h"
#include "middleware/scene/frozen_array.h"
#include "middleware/scene/raw_scene.h"
#include "tessellation/open_edges.h"

namespace foretouch::internal {

struct SceneParts {
  FrozenArray<Triangle> triangles;  // vertices sorted; dropped ones unchanged
  FrozenArray<ObjectId> objectOf;
  std::vector<std::string> objectNames;
  SceneAudit audit;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  FlatBvh bvh;

  /// Ascending. O(n).
  [[nodiscard]] std::vector<TriangleId> finiteIds() const;
  /// Builds them on first use.
  [[nodiscard]] const FlatEdges& flatEdges() const;
  /// One per object; built on first use, too.
  [[nodiscard]] const std::vector<ObjectRoom>& rooms() const;
  /// The flat edges as they were built before.
  void takeFlatEdges(FlatEdges edges) {
    flatEdges_ = std::make_unique<FlatEdges>(std::move(edges));
  }

 private:
  mutable std::mutex mutex_;
  mutable std::unique_ptr<FlatEdges> flatEdges_;
  mutable std::unique_ptr<std::vector<ObjectRoom>> rooms_;
};

}  // namespace foretouch::internal
