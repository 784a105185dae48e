#include "middleware/pair/lane_nearest.h"

#include "lss/rounding.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {

void findNear(const Scene& scene, const AxisEnds& ends, double radius, double reach,
              const std::int32_t* leaf, const std::uint8_t* triangles, std::size_t count,
              NearTriangles& near) {
  const FlatBvh& bvh = scene.parts().bvh;
  const Eigen::Vector3d& treeOrigin = scene.parts().origin;
  // Floats resolve what is near the LSS.
  const Eigen::Vector3f origin = (0.5 * (ends.a + ends.b) - treeOrigin).cast<float>();
  const Eigen::Vector3d origin_W = treeOrigin + origin.cast<double>();
  const Eigen::Vector3d a = ends.a - origin_W, b = ends.b - origin_W;
  const StillLss lss = stillLss(a.data(), b.data(), radius, bvh.vertexRounding());
  findNearTriangles(lss, floatAbove(reach), {bvh.leaves(), bvh.clusters(), leaf, triangles, count},
                    origin.data(), near);
}

void findNear(const Scene& scene, const AxisEnds& ends, double radius, double reach, HitRange range,
              const LeafHits& hits, NearTriangles& near, QueryCounters& counters) {
  const std::size_t count = range.end - range.begin;
  findNear(scene, ends, radius, reach, hits.leaf.data() + range.begin,
           hits.triangles.data() + range.begin, count, near);
  counters.clusterSteps += count;
  counters.candidates += near.looked;
  counters.laneSteps += near.looked;
}

}  // namespace foretouch::internal
