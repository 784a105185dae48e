// middleware/scene/embree_triangles.h: the scene as Embree's own: an RTCScene of triangles in
// float. It answers rays, a yardstick of cost; no query asks it. Not installed.
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include <embree3/rtcore.h>

#include "articulated/result.h"
#include "lss/triangle.h"
#include "middleware/scene/embree_device.h"
#include "middleware/scene/triangle_id.h"

namespace foretouch::internal {

class EmbreeTriangles {
 public:
  /// `triangles[ids[i]]` are the scene's finite triangles, and Embree's primitives i; at least one.
  static Result<std::unique_ptr<EmbreeTriangles>> build(const std::vector<Triangle>& triangles,
                                                        const std::vector<TriangleId>& ids,
                                                        const Eigen::Vector3d& origin);

  /// Does the segment from `from` to `to` (W) hit anything, in float arithmetic? A yardstick, not
  /// an answer.
  [[nodiscard]] bool rayOccluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// Its vertices are relative to the origin, rounded to nearest.
  [[nodiscard]] RTCScene scene() const { return scene_.get(); }
  /// The largest |coordinate| of any vertex, relative to the origin.
  [[nodiscard]] double extent() const { return extent_; }

 private:
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  EmbreeDevice device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double extent_ = 0.0;
};

}  // namespace foretouch::internal
