#include "assets/avatar/humanoid_rest.h"

#include <cmath>

#include "articulated/motion.h"

namespace foretouch {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// The axis, with its sign, that v is nearest to; zero if that is more than kMostTPoseTiltDeg off.
Vector3d axisOf(const Vector3d& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  Vector3d axis = Vector3d::Zero();
  if (!(std::abs(v[largest]) > std::cos(kMostTPoseTiltDeg / kDegrees) * v.norm())) return axis;
  axis[largest] = v[largest] > 0.0 ? 1.0 : -1.0;
  return axis;
}

}  // namespace

double angleDeg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

std::vector<RigidPose> placesIn(const Skeleton& skeleton, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  std::vector<RigidPose> places;
  for (const LinkState& state : states) {
    places.push_back({Quaternion(Matrix3d(state.R_WL)), state.p_WL});
  }
  return places;
}

HumanoidRest::HumanoidRest(const Skeleton& skeleton, Bones bones)
    : bones_(std::move(bones)), places_(placesIn(skeleton, restPose(skeleton))) {}

Vector3d HumanoidRest::between(std::string_view from, std::string_view to) const {
  return at(to) - at(from);
}

double HumanoidRest::legLength() const {
  return between("leftUpperLeg", "leftLowerLeg").norm() +
         between("leftLowerLeg", "leftFoot").norm();
}

Matrix3d HumanoidRest::frame() const {
  const Vector3d left =
      axisOf(between("rightUpperLeg", "leftUpperLeg") + between("rightUpperArm", "leftUpperArm"));
  const Vector3d up = axisOf(between("leftFoot", "head") + between("rightFoot", "head"));
  Matrix3d frame = Matrix3d::Zero();
  if (left.isZero() || up.isZero() || left.dot(up) != 0.0) return frame;
  frame << left, up, left.cross(up);
  return frame;
}

HumanoidRest::Tilt HumanoidRest::farthestFromTPose() const {
  const Matrix3d axes = frame();
  Tilt farthest;
  for (const auto& [begin, end] : kRestingLimbs) {
    const bool isLeg = begin.find("Leg") != std::string_view::npos;
    const bool isLeft = begin.substr(0, 4) == "left";
    const Vector3d expected =
        isLeg ? Vector3d(-axes.col(1)) : Vector3d(axes.col(0) * (isLeft ? 1.0 : -1.0));
    const double tilt = angleDeg(between(begin, end), expected);
    if (!(tilt <= farthest.tiltDeg)) farthest = {tilt, bones_.at(begin)};
  }
  return farthest;
}

}  // namespace foretouch
