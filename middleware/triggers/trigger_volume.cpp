#include "middleware/triggers/trigger_volume.h"

#include <array>
#include <string>
#include <utility>

#include "articulated/skeleton.h"
#include "articulated/try.h"
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

/// The twelve triangles of a box.
RawScene boxOf(const Vector3d& half) {
  const auto corner = [&](int i) {
    return Vector3d((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                    (i & 4) != 0 ? half.z() : -half.z());
  };
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  RawScene raw;
  raw.objectNames = {"box"};
  for (const auto& side : kSides) {
    raw.triangles.push_back({{corner(side[0]), corner(side[1]), corner(side[2])}});
    raw.triangles.push_back({{corner(side[0]), corner(side[2]), corner(side[3])}});
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return raw;
}

}  // namespace

Result<TriggerVolume> TriggerVolume::box(const Vector3d& halfExtents) {
  for (int axis = 0; axis < 3; ++axis) {
    FORETOUCH_CHECK(checkedExtent(halfExtents[axis], "half extent"));
  }
  FORETOUCH_TRY(const Scene scene, Scene::build(boxOf(halfExtents)));
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
