#include "bench/ray_set.h"

#include "articulated/try.h"
#if FORETOUCH_HAS_EMBREE
#include "tests/reference/embree_triangles.h"
#endif

namespace foretouch::tools {

std::array<RaySegment, kRaysPerSet> raysAlong(const ChainMotion& motion) {
  std::array<RaySegment, kRaysPerSet> rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto link = static_cast<LinkId>(i) % motion.numLinks();
    rays[i] = {motion.stateAt(link, 0.0).p_WL, motion.stateAt(link, 1.0).p_WL};
  }
  return rays;
}

#if FORETOUCH_HAS_EMBREE
Result<int> castRaySet(const Scene& scene, const std::array<RaySegment, kRaysPerSet>& rays) {
  FORETOUCH_TRY(const auto triangles, internal::embreeTrianglesOf(scene));
  int hits = 0;
  for (const RaySegment& ray : rays) hits += triangles->rayOccluded(ray.from, ray.to) ? 1 : 0;
  return hits;
}
#else
Result<int> castRaySet(const Scene& /*scene*/,
                       const std::array<RaySegment, kRaysPerSet>& /*rays*/) {
  return Error::of(ErrorCode::DeviceFailed, "expected a build with Embree, whose rays these are");
}
#endif

}  // namespace foretouch::tools
