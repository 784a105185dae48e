#include <string>
#include <utility>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "middleware/scene/box_triangles.h"
#include "middleware/triggers/triggers.h"
#include "middleware/triggers/volume_parts.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

Result<Done> checkedExtent(double extent, const char* name) {
  if (extent > 0.0 && extent <= kMaxCoordinate) return Done{};
  return Error::of(ErrorCode::OutOfRange, std::string("expected a ") + name +
                                              " above 0 and at most 1e7 m, found " +
                                              std::to_string(extent));
}

}  // namespace

Result<TriggerVolume> TriggerVolume::box(const Vector3d& halfExtents) {
  for (int axis = 0; axis < 3; ++axis) {
    FORETOUCH_CHECK(checkedExtent(halfExtents[axis], "half extent"));
  }
  FORETOUCH_TRY(const Scene scene,
                Scene::build(internal::boxTriangles(-halfExtents, halfExtents, "box")));
  return mesh(scene);
}

Result<TriggerVolume> TriggerVolume::sphere(double radius) {
  FORETOUCH_CHECK(checkedExtent(radius, "radius"));
  return lss({Lss{Vector3d::Zero(), Vector3d::Zero(), radius}});
}

Result<TriggerVolume> TriggerVolume::lss(std::vector<Lss> lss) {
  RawSkeleton raw;
  raw.joints.emplace_back();
  raw.joints.front().name = "trigger";
  FORETOUCH_TRY(Skeleton skeleton, Skeleton::build(raw));
  std::vector<std::vector<Lss>> ofLink;
  ofLink.push_back(std::move(lss));
  FORETOUCH_TRY(Avatar avatar, Avatar::build(std::move(skeleton), std::move(ofLink)));
  auto parts = std::make_shared<internal::VolumeParts>();
  parts->solid = std::move(avatar);
  return TriggerVolume(std::move(parts));
}

Result<TriggerVolume> TriggerVolume::mesh(const Scene& closed) {
  FORETOUCH_TRY(internal::ClosedMesh mesh, internal::ClosedMesh::build(closed));
  auto parts = std::make_shared<internal::VolumeParts>();
  parts->mesh = std::move(mesh);
  return TriggerVolume(std::move(parts));
}

}  // namespace foretouch
