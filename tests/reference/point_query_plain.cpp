// The point-query culler of a library without Embree: every triangle's box, one after the other.
#include "lss/index.h"
#include "middleware/scene/scene_parts.h"
#include "tests/reference/point_query_culler.h"

namespace foretouch::internal {

Result<std::shared_ptr<const PointQueryCuller>> PointQueryCuller::build(const Scene& scene) {
  return std::shared_ptr<const PointQueryCuller>(new PointQueryCuller(scene, nullptr));
}

void PointQueryCuller::collect(const Aabb& box, std::vector<TriangleId>& ids,
                               std::uint64_t& visited) const {
  const SceneParts& parts = scene_.parts();
  const std::vector<TriangleId> finite = parts.finiteIds();
  for (const TriangleId id : finite) {
    if (boxOf(parts.triangles[slotOf(id)]).overlaps(box)) ids.push_back(id);
  }
  visited += finite.size();
}

}  // namespace foretouch::internal
