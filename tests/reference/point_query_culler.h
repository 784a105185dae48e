// tests/reference/point_query_culler.h: the culler that shares nothing with the flat tree but
// the triangles: Embree's own RTCScene and rtcPointQuery with the sphere around the given box.
// Slower, and the same answers, byte for byte. Where Embree is not, every triangle's own box
// instead.
//
// Constraints of Embree 3.13.5, checked against its documentation: rtcPointQuery visits whole
// leaves, checks no arguments and compares squared float distances without outward rounding; vertex
// buffers are float. So we inflate the sphere past all of that, and the caller filters in double.
#pragma once

#include <memory>
#include <vector>

#include "articulated/result.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

class EmbreeTriangles;

class PointQueryCuller final : public TriangleCuller {
 public:
  /// Keeps the scene, and builds Embree's triangles with the first culler of it. O(triangles).
  static Result<std::shared_ptr<const PointQueryCuller>> build(const Scene& scene);

  void collect(const Aabb& box, std::vector<TriangleId>& ids,
               std::uint64_t& visited) const override;
  void collectLeaves(const BoxLanes& boxes, std::vector<LeafHit>& hits, std::uint64_t& nodesVisited,
                     std::uint64_t& leavesVisited) const override;

 private:
  /// Where a triangle lies in the scene's flat tree.
  struct Place {
    std::uint32_t leaf = 0;
    std::uint8_t triangle = 0;  ///< One bit.
  };

  PointQueryCuller(const Scene& scene, std::shared_ptr<const EmbreeTriangles> triangles);

  Scene scene_;
  std::shared_ptr<const EmbreeTriangles> triangles_;  // the scene's; null where Embree is not
  std::vector<Place> places_;                         // per triangle
};

}  // namespace foretouch::internal
