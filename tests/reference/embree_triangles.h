// tests/reference/embree_triangles.h: the scene as Embree's own: an RTCScene of triangles in float.
// It answers the slower culler, and rays, a yardstick of cost; no query of the product asks it.
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <embree3/rtcore.h>

#include "articulated/result.h"
#include "middleware/scene/embree_device.h"
#include "middleware/scene/scene.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {

class EmbreeTriangles {
 public:
  /// Of the scene's finite triangles, Embree's primitive i is ids()[i]; at least one. Keeps the
  /// scene.
  static Result<std::shared_ptr<const EmbreeTriangles>> build(const Scene& scene);

  /// Does the segment from `from` to `to` (W) hit anything, in float arithmetic? A yardstick, not
  /// an answer.
  [[nodiscard]] bool rayOccluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// The same, but looks for the first one (rtcIntersect1).
  [[nodiscard]] bool rayHits(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// Its vertices are relative to the scene's origin, rounded to nearest.
  [[nodiscard]] RTCScene scene() const { return embreeScene_.get(); }
  [[nodiscard]] const std::vector<TriangleId>& ids() const { return ids_; }
  /// The largest |coordinate| of any vertex, relative to the origin.
  [[nodiscard]] double extent() const { return extent_; }
  [[nodiscard]] bool isOf(const Scene& scene) const { return &scene_.parts() == &scene.parts(); }

 private:
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  explicit EmbreeTriangles(const Scene& scene) : scene_(scene), ids_(scene.parts().finiteIds()) {}
  void fill(float* vertices, unsigned* indices);
  [[nodiscard]] RTCRay rayOf(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  Scene scene_;
  std::vector<TriangleId> ids_;
  EmbreeDevice device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> embreeScene_;
  double extent_ = 0.0;
};

/// Built on first use; the last scene's are kept.
[[nodiscard]] Result<std::shared_ptr<const EmbreeTriangles>> embreeTrianglesOf(const Scene& scene);

}  // namespace foretouch::internal
