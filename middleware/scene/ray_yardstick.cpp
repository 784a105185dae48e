#include "middleware/scene/ray_yardstick.h"

#include "middleware/scene/scene_parts.h"

namespace foretouch {

Result<int> castRaySet(const Scene& scene, const std::array<RaySegment, kRaysPerSet>& rays) {
  const auto culler = scene.parts().pointQueryCuller();
  if (!culler.ok()) return culler.error();
  int hits = 0;
  for (const RaySegment& ray : rays) hits += culler.value()->rayOccluded(ray.from, ray.to) ? 1 : 0;
  return hits;
}

}  // namespace foretouch
