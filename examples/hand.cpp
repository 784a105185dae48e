#include "examples/hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "examples/circle.h"
#include "examples/track.h"
#include "lss/turn_between.h"

namespace foretouch::examples {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

enum ArmJoint : std::int32_t { kArm, kForeArm, kHand, kFingers, kThumb };

constexpr double kUpper = 0.28, kLower = 0.25;

const Vector3d kShoulder(0.0, 1.02, 0.0);
/// Where the elbow points: to the side, so that it stays above the desk.
const Vector3d kElbowSide(1.0, 0.25, -0.3);

/// Seconds, and the wrist's place.
constexpr double kWristKeys[][4] = {
    {0.0, -0.16, 0.94, 0.26}, {0.7, -0.16, 0.92, 0.28}, {1.2, -0.16, 0.71, 0.30},
    {1.8, -0.16, 0.71, 0.30}, {3.0, 0.20, 0.71, 0.33},  {3.4, 0.20, 0.71, 0.33},
    {3.8, 0.20, 0.92, 0.30},  {4.6, 0.05, 0.95, 0.28},
};

Vector3d wristAt(double timeS) {
  std::array<Track, 3> tracks;
  for (const auto& key : kWristKeys) {
    for (std::size_t axis = 0; axis < 3; ++axis) tracks[axis].key(key[0], key[axis + 1]);
  }
  return {tracks[0].at(timeS), tracks[1].at(timeS), tracks[2].at(timeS)};
}

/// The elbow between two bones from the shoulder to the wrist.
Vector3d elbowFor(const Vector3d& wrist) {
  const Vector3d way = wrist - kShoulder;
  const double reach = std::min(way.norm(), 0.999 * (kUpper + kLower));
  const Vector3d ahead = way.normalized();
  const double along = (kUpper * kUpper - kLower * kLower + reach * reach) / (2.0 * reach);
  const Vector3d aside = (kElbowSide - kElbowSide.dot(ahead) * ahead).normalized();
  return kShoulder + along * ahead +
         std::sqrt(std::max(0.0, kUpper * kUpper - along * along)) * aside;
}

/// The links lie along their +X.
Quaterniond pointingAlong(const Vector3d& direction) {
  return turnBetween(Vector3d::UnitX(), direction);
}

}  // namespace

Result<Avatar> handAvatar() {
  RawSkeleton raw;
  const auto add = [&](const char* name, std::int32_t parent, const Vector3d& offset) {
    raw.joints.push_back({name, parent, offset, Quaternion::Identity()});
  };
  add("Arm", kNoParent, kShoulder);
  add("ForeArm", kArm, {kUpper, 0, 0});
  add("Hand", kForeArm, {kLower, 0, 0});
  add("Fingers", kHand, {0.095, 0, 0});
  add("Thumb", kHand, {0.035, -0.01, 0.035});
  std::vector<std::vector<Lss>> lss = {{{{0, 0, 0}, {0.27, 0, 0}, 0.048}},
                                       {{{0, 0, 0}, {0.24, 0, 0}, 0.038}},
                                       {{{0.015, 0, -0.012}, {0.075, 0, -0.012}, 0.028},
                                        {{0.015, 0, 0.012}, {0.075, 0, 0.012}, 0.028}},
                                       {{{0, 0, 0}, {0.075, 0, 0}, 0.018}},
                                       {{{0, 0, 0}, {0.035, -0.004, 0.03}, 0.013}}};
  auto skeleton = Skeleton::build(raw);
  if (!skeleton.ok()) return skeleton.error();
  return Avatar::build(std::move(skeleton).value(), std::move(lss));
}

Pose handPoseAt(const Skeleton& arm, double timeS) {
  constexpr double kQuarter = 0.5 * kPi;
  const Vector3d wrist = wristAt(timeS), elbow = elbowFor(wrist);
  const Quaterniond upper = pointingAlong(elbow - kShoulder);
  const Quaterniond lower = pointingAlong(wrist - elbow);
  // Flat, fingers ahead: +X to +Z.
  const Quaterniond hand(Eigen::AngleAxisd(-kQuarter, Vector3d::UnitY()));
  Pose pose = restPose(arm);
  pose.rotations[kArm] = Quaternion(upper);
  pose.rotations[kForeArm] = Quaternion(upper.conjugate() * lower);
  pose.rotations[kHand] = Quaternion(lower.conjugate() * hand);
  return pose;
}

void addDesk(MeshBuilder& mesh) {
  constexpr double kFront = 0.14, kBack = 0.84, kHalf = 0.7, kBoard = 0.03;
  mesh.begin("floor");
  mesh.surface(8, 8, false, [](double u, double v) -> Vector3d {
    return {3.0 * v - 1.5, 0.0, 1.5 - 2.5 * u};
  });
  mesh.begin("desk_top");
  // In many triangles, as scanned desks are: what slides must not feel them.
  mesh.surface(18, 34, false, [&](double u, double v) -> Vector3d {
    return {2.0 * kHalf * v - kHalf, kDeskTop, kBack - (kBack - kFront) * u};
  });
  mesh.box({-kHalf, kDeskTop - kBoard, kFront}, {kHalf, kDeskTop - 0.001, kBack});
  mesh.begin("desk_legs");
  for (const double x : {-kHalf + 0.02, kHalf - 0.07}) {
    for (const double z : {kFront + 0.02, kBack - 0.07}) {
      mesh.box({x, 0.0, z}, {x + 0.05, kDeskTop - kBoard, z + 0.05});
    }
  }
  mesh.begin("drawers");
  mesh.box({0.2, 0.12, kFront + 0.06}, {0.6, kDeskTop - kBoard, kBack - 0.1});
  mesh.begin("book");
  mesh.box({0.36, kDeskTop, 0.36}, {0.58, kDeskTop + 0.035, 0.66});
}

}  // namespace foretouch::examples
