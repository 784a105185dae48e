// middleware/scene/scene.h: the static scene: triangles with their objects' names, ready to be
// queried. World W: metres, right-handed, +Y up. No Embree type shows here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "lss/lss.h"
#include "middleware/scene/raw_scene.h"

namespace foretouch {

namespace internal {
struct SceneParts;
}

/// An immutable scene with its acceleration structures. Cheap to copy (shared); safe to query from
/// many threads at once. Triangle ids are the positions in RawScene::triangles, dropped ones
/// included.
class Scene {
 public:
  /// Checks counts, object indices and |coordinate| <= kMaxCoordinate, drops triangles that are not
  /// finite, builds the acceleration structures. Error if no triangle is left.
  static Result<Scene> build(RawScene raw);

  [[nodiscard]] std::size_t numTriangles() const;
  /// The vertices in lexicographic order, so that two triangles evaluate what they share alike, bit
  /// for bit.
  [[nodiscard]] const Triangle& triangle(TriangleId id) const;
  [[nodiscard]] ObjectId object(TriangleId id) const;
  [[nodiscard]] const std::vector<std::string>& objectNames() const;
  [[nodiscard]] const SceneAudit& audit() const;

  /// For the library's own sources (middleware/scene/scene_parts.h).
  [[nodiscard]] const internal::SceneParts& parts() const { return *parts_; }
  explicit Scene(std::shared_ptr<const internal::SceneParts> parts) : parts_(std::move(parts)) {}

 private:
  std::shared_ptr<const internal::SceneParts> parts_;
};

}  // namespace foretouch
