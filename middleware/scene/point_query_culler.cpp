#include "middleware/scene/point_query_culler.h"

#include <algorithm>
#include <cmath>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

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

Result<std::unique_ptr<PointQueryCuller>> PointQueryCuller::build(
    const std::vector<Triangle>& triangles, const std::vector<TriangleId>& ids,
    const Eigen::Vector3d& origin) {
  FORETOUCH_ASSERT(!ids.empty());
  FORETOUCH_TRY(auto device, newEmbreeDevice());
  auto culler = std::make_unique<PointQueryCuller>();
  culler->device_ = std::move(device);
  culler->idOf_ = ids;
  culler->origin_ = origin;
  RTCGeometry geometry = rtcNewGeometry(culler->device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * ids.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), ids.size()));
  if (vertices != nullptr && indices != nullptr) {
    for (std::size_t i = 0; i < 3 * ids.size(); ++i) {
      const Eigen::Vector3d local = triangles[slotOf(ids[i / 3])].vertices[i % 3] - origin;
      culler->extent_ = std::max(culler->extent_, local.cwiseAbs().maxCoeff());
      for (int axis = 0; axis < 3; ++axis) vertices[3 * i + axis] = static_cast<float>(local[axis]);
      indices[i] = static_cast<unsigned>(i);
    }
    rtcCommitGeometry(geometry);
    culler->scene_.reset(rtcNewScene(culler->device_.get()));
    rtcAttachGeometry(culler->scene_.get(), geometry);
    rtcCommitScene(culler->scene_.get());
  }
  rtcReleaseGeometry(geometry);
  FORETOUCH_CHECK(embreeStatus(culler->device_.get(), "building the reference scene"));
  return culler;
}

void PointQueryCuller::collect(const Aabb& box, std::vector<TriangleId>& ids,
                               std::uint64_t& visited) const {
  const Eigen::Vector3d center = 0.5 * (box.min + box.max) - origin_;
  const double radius = 0.5 * (box.max - box.min).norm();
  const double coordinates = std::max(extent_, center.cwiseAbs().maxCoeff());
  RTCPointQuery query;
  query.x = static_cast<float>(center.x());
  query.y = static_cast<float>(center.y());
  query.z = static_cast<float>(center.z());
  query.time = 0.0f;
  query.radius = floatAbove(radius * (1.0 + kFloatSlack) + coordinates * kFloatSlack);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Collected collected{&idOf_, &ids, 0};
  rtcPointQuery(scene_.get(), &query, &context, collectPrimitive, &collected);
  visited += collected.visited;
}

bool PointQueryCuller::rayOccluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const Eigen::Vector3f start = (from - origin_).cast<float>();
  const Eigen::Vector3f along = (to - from).cast<float>();
  RTCRay ray{};
  ray.org_x = start.x();
  ray.org_y = start.y();
  ray.org_z = start.z();
  ray.dir_x = along.x();
  ray.dir_y = along.y();
  ray.dir_z = along.z();
  ray.tnear = 0.0f;
  ray.tfar = 1.0f;
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &ray);
  return ray.tfar < 0.0f;  // Embree sets it to -inf on a hit
}

}  // namespace foretouch::internal
