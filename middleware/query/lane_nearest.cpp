#include "middleware/query/lane_nearest.h"

#include <algorithm>

#include "lss/rounding.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// No pair is certainly in contact.
constexpr float kNeverCertain = -1.0F;
/// All of a step that nothing moves in.
constexpr float kBegin = -1.0F, kEnd = 1.0F;
constexpr std::size_t kPartsAtOnce = 16;

/// Around the LSS grown by the reach, relative to the tree's origin.
FloatBox boxAround(const AxisEnds& ends, double grown, const Eigen::Vector3d& origin) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double least = std::min(ends.a[axis], ends.b[axis]) - grown - origin[axis];
    const double most = std::max(ends.a[axis], ends.b[axis]) + grown - origin[axis];
    box.lower[axis] = -floatPaddedAbove(-least);
    box.upper[axis] = floatPaddedAbove(most);
  }
  return box;
}

/// The leaves whose spheres are near.
void findLeaves(const Scene& scene, HitRange hits, ScratchParts& scratch) {
  LaneScratch& lanes = scratch.lanes;
  lanes.leafParts.clear();
  for (std::size_t i = 0; i < lanes.clusters.count; ++i) {
    const auto hit = hits.begin + static_cast<std::uint32_t>(lanes.clusters.key[i]);
    const BvhLeaf& leaf = scene.parts().bvh.leaf(static_cast<std::uint32_t>(lanes.leaf[hit]));
    const std::uint8_t asked = withoutIgnored(lanes.triangles[hit], leaf, scene, scratch.ignored);
    if (asked != 0) lanes.leafParts.push_back({&leaf, asked, kBegin});
  }
}

}  // namespace

void findNear(const Scene& scene, const AxisEnds& ends, double radius, double reach, HitRange hits,
              ScratchParts& scratch, QueryCounters& counters) {
  LaneScratch& lanes = scratch.lanes;
  const FlatBvh& bvh = scene.parts().bvh;
  const Eigen::Vector3d& treeOrigin = scene.parts().origin;
  // Floats resolve what is near the LSS.
  const Eigen::Vector3f origin = (0.5 * (ends.a + ends.b) - treeOrigin).cast<float>();
  const Eigen::Vector3d origin_W = treeOrigin + origin.cast<double>();
  const Eigen::Vector3d a = ends.a - origin_W, b = ends.b - origin_W;
  const LaneLss lss = stillLss(a.data(), b.data(), radius);
  const LaneTolerances tolerances{floatAbove(reach), floatAbove(reach), kNeverCertain};
  lanes.pairs.setSpheres(lss, bvh.clusters(), lanes.leaf.data() + hits.begin, hits.end - hits.begin,
                         origin.data(), kBegin);
  lanes.clusters.count = 0;
  counters.clusterSteps += lanes.pairs.advanceSpheres(lss, tolerances, 1, kEnd, lanes.clusters);
  findLeaves(scene, hits, scratch);
  const FloatBox box = boxAround(ends, radius + reach, treeOrigin);
  lanes.handed.count = 0;
  for (std::size_t done = 0; done < lanes.leafParts.size(); done += kPartsAtOnce) {
    lanes.pairs.addTriangles(lss, lanes.leafParts.data() + done,
                             std::min(kPartsAtOnce, lanes.leafParts.size() - done), box,
                             origin.data(), bvh.vertexRounding());
    counters.candidates += lanes.pairs.count();
    float best = kEnd;
    counters.laneSteps += lanes.pairs.advanceTriangles(lss, tolerances, best, lanes.handed);
  }
}

}  // namespace foretouch::internal
