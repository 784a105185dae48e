#include "tools/setup/level.h"

#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

Result<Avatar> pointAvatar() {
  RawSkeleton bones;
  bones.joints.push_back({"point", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  FORETOUCH_TRY(auto skeleton, Skeleton::build(bones));
  return Avatar::build(std::move(skeleton), {{Lss{Vector3d::Zero(), Vector3d::Zero(), 0.0}}});
}

Pose poseOfPoint(const Avatar& point, const Vector3d& at) {
  Pose pose = restPose(point.skeleton());
  pose.translations.front() = at;
  return pose;
}

Vector3d areaOf(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const Vector3d area = 0.5 * (b - a).cross(c - a);
  return area.allFinite() ? area : Vector3d::Zero();
}

}  // namespace

Level::Level(Scene scene, std::vector<Vector3d> areas, Avatar point, Query query)
    : scene_(std::move(scene)),
      areas_(std::move(areas)),
      point_(std::move(point)),
      query_(std::move(query)),
      scratch_(std::make_unique<Scratch>()) {}

Result<Level> Level::build(RawScene raw) {
  // A Scene sorts the vertices of its triangles, so their sides must be read before.
  std::vector<Vector3d> areas;
  areas.reserve(raw.triangles.size());
  for (const Triangle& triangle : raw.triangles) areas.push_back(areaOf(triangle));
  FORETOUCH_TRY(auto scene, Scene::build(std::move(raw)));
  FORETOUCH_TRY(auto point, pointAvatar());
  FORETOUCH_TRY(auto query, Query::build(point, scene));
  return Level(std::move(scene), std::move(areas), std::move(point), std::move(query));
}

Vector3d Level::normal(TriangleId triangle) const {
  const Vector3d& area = areas_[slotOf(triangle)];
  const double size = area.norm();
  return size > 0.0 ? Vector3d(area / size) : Vector3d::Zero();
}

std::optional<LevelHit> Level::cast(const Vector3d& from, const Vector3d& to) const {
  const ChainMotion motion(point_.skeleton(), poseOfPoint(point_, from), poseOfPoint(point_, to));
  const StepContacts step = query_.answer(motion, *scratch_);
  const LinkContact& contact = step.links.front();
  if (contact.verdict != Verdict::Contact && contact.verdict != Verdict::StartsInContact) {
    return std::nullopt;
  }
  return LevelHit{contact.toi * (to - from).norm(), contact.triangle};
}

}  // namespace foretouch::tools
