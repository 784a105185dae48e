#include "tests/reference/embree_triangles.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {

void EmbreeTriangles::fill(float* vertices, unsigned* indices) {
  const SceneParts& parts = scene_.parts();
  for (std::size_t i = 0; i < 3 * ids_.size(); ++i) {
    const Triangle& triangle = parts.triangles[slotOf(ids_[i / 3])];
    const Eigen::Vector3d local = triangle.vertices[i % 3] - parts.origin;
    extent_ = std::max(extent_, local.cwiseAbs().maxCoeff());
    for (int axis = 0; axis < 3; ++axis) vertices[3 * i + axis] = static_cast<float>(local[axis]);
    indices[i] = static_cast<unsigned>(i);
  }
}

Result<std::shared_ptr<const EmbreeTriangles>> EmbreeTriangles::build(const Scene& scene) {
  FORETOUCH_TRY(auto device, newEmbreeDevice());
  const std::shared_ptr<EmbreeTriangles> built(new EmbreeTriangles(scene));
  const std::size_t count = built->ids().size();
  built->device_ = std::move(device);
  RTCGeometry geometry = rtcNewGeometry(built->device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  if (vertices != nullptr && indices != nullptr) {
    built->fill(vertices, indices);
    rtcCommitGeometry(geometry);
    built->embreeScene_.reset(rtcNewScene(built->device_.get()));
    rtcAttachGeometry(built->embreeScene_.get(), geometry);
    rtcCommitScene(built->embreeScene_.get());
  }
  rtcReleaseGeometry(geometry);
  FORETOUCH_CHECK(embreeStatus(built->device_.get(), "building the scene of rays"));
  return std::shared_ptr<const EmbreeTriangles>(built);
}

RTCRay EmbreeTriangles::rayOf(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const Eigen::Vector3f start = (from - scene_.parts().origin).cast<float>();
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
  return ray;
}

bool EmbreeTriangles::rayOccluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  RTCRay ray = rayOf(from, to);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embreeScene_.get(), &context, &ray);
  return ray.tfar < 0.0f;  // Embree sets it to -inf on a hit
}

bool EmbreeTriangles::rayHits(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  RTCRayHit ray{};
  ray.ray = rayOf(from, to);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embreeScene_.get(), &context, &ray);
  return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

Result<std::shared_ptr<const EmbreeTriangles>> embreeTrianglesOf(const Scene& scene) {
  static std::mutex mutex;
  // Never destroyed: Embree's own threads may have ended by then.
  static auto& last = *new std::shared_ptr<const EmbreeTriangles>();
  const std::lock_guard<std::mutex> lock(mutex);
  if (last == nullptr || !last->isOf(scene)) {
    FORETOUCH_TRY(last, EmbreeTriangles::build(scene));
  }
  return last;
}

}  // namespace foretouch::internal
