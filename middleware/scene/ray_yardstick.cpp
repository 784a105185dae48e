#include "middleware/scene/ray_yardstick.h"

#include "articulated/try.h"
#include "middleware/scene/embree_triangles.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch {

bool canCastRays() {
  return true;
}

Result<int> castRaySet(const Scene& scene, const std::array<RaySegment, kRaysPerSet>& rays) {
  FORETOUCH_TRY(const auto triangles, scene.parts().embreeTriangles());
  int hits = 0;
  for (const RaySegment& ray : rays) hits += triangles->rayOccluded(ray.from, ray.to) ? 1 : 0;
  return hits;
}

}  // namespace foretouch
