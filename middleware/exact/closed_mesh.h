// middleware/exact/closed_mesh.h: a mesh that has an inside, and which points are in it. Exact.
// Metres, in the mesh's own frame. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "middleware/exact/ray_up.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

enum class PointPlace : std::uint8_t {
  Outside,
  Inside,
  AtSurface,  ///< Nearer to the surface than the point is known.
};

/// The objects that a point is in, or at; each once, in order.
struct ObjectsAround {
  std::vector<ObjectId> inside;     ///< Closed ones that were crossed an odd number of times.
  std::vector<ObjectId> atSurface;  ///< Nearer to it than the point is known.
  std::vector<TriangleId> ids;      ///< Memory.
};
/// Replaces both. `rounding`: the point is not farther from where it is given (m).
void findObjectsAround(const SceneParts& scene, const Eigen::Vector3d& p, double rounding,
                       ObjectsAround& around);
/// The same for loose triangles, all of object 0.
void findObjectsAround(const std::vector<Triangle>& triangles, const Eigen::Vector3d& p,
                       double rounding, ObjectsAround& around);

/// Each object of the scene by itself is a surface without a border: of its triangles, every edge
/// belongs to two, or to another even number. Their order and the way they are turned do not
/// matter. A point is inside if it is inside some object: if a ray from it crosses that object an
/// odd number of times.
class ClosedMesh {
 public:
  /// Error (Mismatch): an object with an open edge; the message names the object and the edge, and
  /// Error::index a triangle of it. O(n log n).
  static Result<ClosedMesh> build(Scene scene);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// `rounding`: the point is not farther from where it is given (m). Exact beyond that. O(log n,
  /// and what is above the point). For one thread at a time, per `memory`.
  using Memory = ObjectsAround;
  [[nodiscard]] PointPlace placeOf(const Eigen::Vector3d& p, double rounding, Memory& memory) const;

 private:
  explicit ClosedMesh(Scene scene) : scene_(std::move(scene)) {}
  Scene scene_;
};

}  // namespace foretouch::internal
