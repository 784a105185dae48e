#include "middleware/scene/embree_triangles.h"

#include <algorithm>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {

Result<std::unique_ptr<EmbreeTriangles>> EmbreeTriangles::build(
    const std::vector<Triangle>& triangles, const std::vector<TriangleId>& ids,
    const Eigen::Vector3d& origin) {
  FORETOUCH_ASSERT(!ids.empty());
  FORETOUCH_TRY(auto device, newEmbreeDevice());
  auto built = std::make_unique<EmbreeTriangles>();
  built->device_ = std::move(device);
  built->origin_ = origin;
  RTCGeometry geometry = rtcNewGeometry(built->device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * ids.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), ids.size()));
  if (vertices != nullptr && indices != nullptr) {
    for (std::size_t i = 0; i < 3 * ids.size(); ++i) {
      const Eigen::Vector3d local = triangles[slotOf(ids[i / 3])].vertices[i % 3] - origin;
      built->extent_ = std::max(built->extent_, local.cwiseAbs().maxCoeff());
      for (int axis = 0; axis < 3; ++axis) vertices[3 * i + axis] = static_cast<float>(local[axis]);
      indices[i] = static_cast<unsigned>(i);
    }
    rtcCommitGeometry(geometry);
    built->scene_.reset(rtcNewScene(built->device_.get()));
    rtcAttachGeometry(built->scene_.get(), geometry);
    rtcCommitScene(built->scene_.get());
  }
  rtcReleaseGeometry(geometry);
  FORETOUCH_CHECK(embreeStatus(built->device_.get(), "building the scene of rays"));
  return built;
}

bool EmbreeTriangles::rayOccluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
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

Result<const EmbreeTriangles*> SceneParts::embreeTriangles() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (embreeTriangles_ == nullptr) {
    FORETOUCH_TRY(embreeTriangles_, EmbreeTriangles::build(triangles, finiteIds, origin));
  }
  return embreeTriangles_.get();
}

}  // namespace foretouch::internal
