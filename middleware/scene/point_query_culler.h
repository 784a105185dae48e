// middleware/scene/point_query_culler.h: the reference culler: an RTCScene of triangles and
// rtcPointQuery with the sphere around the given box. The same scene answers rays. Not installed.
//
// Constraints of Embree 3.13.5, checked against its documentation: rtcPointQuery visits whole
// leaves, checks no arguments and compares squared float distances without outward rounding; vertex
// buffers are float. So we inflate the sphere past all of that, and the caller filters in double.
#pragma once

#include <memory>
#include <vector>

#include <embree3/rtcore.h>

#include "articulated/result.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/embree_device.h"

namespace foretouch::internal {

class PointQueryCuller final : public TriangleCuller {
 public:
  /// `triangles[ids[i]]` are the scene's finite triangles; at least one.
  static Result<std::unique_ptr<PointQueryCuller>> build(const std::vector<Triangle>& triangles,
                                                         const std::vector<TriangleId>& ids,
                                                         const Eigen::Vector3d& origin);

  void collect(const Aabb& box, std::vector<TriangleId>& ids,
               std::uint64_t& visited) const override;

  /// Does the segment from `from` to `to` (W) hit anything, in float arithmetic? A yardstick, not
  /// an answer.
  [[nodiscard]] bool rayOccluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  EmbreeDevice device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene_;
  std::vector<TriangleId> idOf_;  // per Embree primitive
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double extent_ = 0.0;  // largest local coordinate of any vertex
};

}  // namespace foretouch::internal
