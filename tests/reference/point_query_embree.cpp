// The point-query culler by Embree.
#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/rounding.h"
#include "middleware/scene/scene_parts.h"
#include "tests/reference/embree_triangles.h"
#include "tests/reference/point_query_culler.h"

namespace foretouch::internal {
namespace {

/// Float has 24 bits: a vertex or the sphere's centre moves by at most 2^-24 of its coordinate per
/// axis, and the squared distance is off by a few 2^-23 of itself. Ten times that, on both.
constexpr double kFloatSlack = 2e-6;

struct Collected {
  const std::vector<TriangleId>* idOf;
  std::vector<TriangleId>* ids;
  std::uint64_t visited = 0;
};

bool collectPrimitive(RTCPointQueryFunctionArguments* arguments) {
  auto& collected = *static_cast<Collected*>(arguments->userPtr);
  collected.ids->push_back((*collected.idOf)[arguments->primID]);
  ++collected.visited;
  return false;  // the radius stays
}

}  // namespace

Result<std::shared_ptr<const PointQueryCuller>> PointQueryCuller::build(const Scene& scene) {
  FORETOUCH_TRY(auto triangles, embreeTrianglesOf(scene));
  return std::shared_ptr<const PointQueryCuller>(new PointQueryCuller(scene, std::move(triangles)));
}

void PointQueryCuller::collect(const Aabb& box, std::vector<TriangleId>& ids,
                               std::uint64_t& visited) const {
  const SceneParts& parts = scene_.parts();
  const Eigen::Vector3d center = 0.5 * (box.min + box.max) - parts.origin;
  const double radius = 0.5 * (box.max - box.min).norm();
  const double coordinates = std::max(triangles_->extent(), center.cwiseAbs().maxCoeff());
  RTCPointQuery query;
  query.x = static_cast<float>(center.x());
  query.y = static_cast<float>(center.y());
  query.z = static_cast<float>(center.z());
  query.time = 0.0f;
  query.radius = floatAbove(radius * (1.0 + kFloatSlack) + coordinates * kFloatSlack);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Collected collected{&triangles_->ids(), &ids, 0};
  rtcPointQuery(triangles_->scene(), &query, &context, collectPrimitive, &collected);
  visited += collected.visited;
}

}  // namespace foretouch::internal
