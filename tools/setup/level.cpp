#include "tools/setup/level.h"

#include <algorithm>
#include <cmath>
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

bool isFloor(const Vector3d& area, double steepest) {
  const double size = area.norm();
  return size > 0.0 && std::abs(area.y()) >= size * std::cos(steepest);
}

/// The n-th number of a sequence that fills [0, 1) evenly: van der Corput's, in base `base`.
double evenly(std::size_t n, std::size_t base) {
  double result = 0.0, digit = 1.0;
  for (; n > 0; n /= base) {
    digit /= static_cast<double>(base);
    result += digit * static_cast<double>(n % base);
  }
  return result;
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
  const Vector3d way = to - from;
  return LevelHit{contact.toi * way.norm(), contact.triangle,
                  normal(contact.triangle).dot(way) <= 0.0};
}

double Level::floorArea(double steepest) const {
  double sum = 0.0;
  for (const Vector3d& area : areas_) sum += isFloor(area, steepest) ? area.norm() : 0.0;
  return sum;
}

std::vector<FloorSpot> Level::floorSpots(std::size_t count, double steepest) const {
  std::vector<FloorSpot> spots;
  const double perSpot = floorArea(steepest) / static_cast<double>(count);
  if (!(perSpot > 0.0)) return spots;
  spots.reserve(count);
  double passed = 0.0;  // area before this triangle
  for (std::size_t i = 0; i < areas_.size(); ++i) {
    if (!isFloor(areas_[i], steepest)) continue;
    const double size = areas_[i].norm();
    const auto& [a, b, c] = scene_.triangle(static_cast<TriangleId>(i)).vertices;
    // The middle of each share of the area that lies in this triangle.
    while ((static_cast<double>(spots.size()) + 0.5) * perSpot < passed + size &&
           spots.size() < count) {
      double u = evenly(spots.size() + 1, 2), v = evenly(spots.size() + 1, 3);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      spots.push_back({a + u * (b - a) + v * (c - a), areas_[i].y() > 0.0});
    }
    passed += size;
  }
  return spots;
}

}  // namespace foretouch::tools
