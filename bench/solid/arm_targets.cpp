#include "bench/solid/arm_targets.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lss/turn_between.h"

namespace foretouch::tools {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// The figure's lengths: from the shoulder to the elbow, and on to the wrist.
constexpr double kUpper = 0.28, kLower = 0.25;

Quaternion fromRest(const Vector3d& direction) {
  return foretouch::turnBetween(-Vector3d::UnitX(), direction);
}

std::size_t jointOf(const Avatar& figure, const char* name) {
  return slotOf(*figure.skeleton().find(name));
}

}  // namespace

RightArm::RightArm(const Avatar& figure)
    : arm(jointOf(figure, "RightArm")),
      foreArm(jointOf(figure, "RightForeArm")),
      hand(jointOf(figure, "RightHand")),
      shoulder(Vector3d::Zero()) {
  const Pose rest = restPose(figure.skeleton());
  for (auto joint = static_cast<JointId>(arm); joint != kNoParent;
       joint = figure.skeleton().parent(joint)) {
    shoulder += rest.translations[slotOf(joint)];
  }
}

Pose reachingFor(const Avatar& figure, const RightArm& right, const Vector3d& wrist) {
  const Vector3d way = wrist - right.shoulder;
  const Vector3d ahead = way.normalized();
  const double far = std::clamp(way.norm(), kUpper - kLower, kUpper + kLower);
  const double cosine = (kUpper * kUpper + far * far - kLower * kLower) / (2.0 * kUpper * far);
  const double bend = std::acos(std::clamp(cosine, -1.0, 1.0));
  const Vector3d down = (-Vector3d::UnitY() + ahead.y() * ahead).normalized();
  const Vector3d upper = std::cos(bend) * ahead + std::sin(bend) * down;
  const Quaternion atArm = fromRest(upper);
  const Quaternion atFore = fromRest((far * ahead - kUpper * upper).normalized());
  Pose pose = restPose(figure.skeleton());
  pose.rotations[right.arm] = atArm;
  pose.rotations[right.foreArm] = (atArm.conjugate() * atFore).normalized();
  pose.rotations[right.hand] = (atFore.conjugate() * fromRest(-Vector3d::UnitZ())).normalized();
  return pose;
}

Pose pointingAnywhere(const Avatar& figure, const RightArm& right, PortableRandom& random) {
  const double yaw = random.uniform(-0.2, 1.9), pitch = random.uniform(-0.9, 0.9),
               roll = random.uniform(-3.1, 3.1), bend = random.uniform(0.0, 2.0),
               wrist = random.uniform(-0.6, 0.6);
  Pose pose = restPose(figure.skeleton());
  pose.rotations[right.arm] = Quaternion(AngleAxisd(-yaw, Vector3d::UnitY())) *
                              Quaternion(AngleAxisd(pitch, Vector3d::UnitZ())) *
                              Quaternion(AngleAxisd(roll, Vector3d::UnitX()));
  pose.rotations[right.foreArm] = Quaternion(AngleAxisd(-bend, Vector3d::UnitY()));
  pose.rotations[right.hand] = Quaternion(AngleAxisd(wrist, Vector3d::UnitZ()));
  return pose;
}

}  // namespace foretouch::tools
