#include "bench/peers/rigid_sweep.h"

#include <algorithm>

namespace foretouch::tools {

using Eigen::Vector3d;

RigidPose poseAt(const RigidSweep& sweep, double t) {
  RigidPose pose;
  pose.pivot = sweep.from + t * (sweep.to - sweep.from);
  pose.rotation = sweep.rotation;
  if (const double angle = sweep.turn.norm(); angle > 0.0) {
    pose.rotation = Quaternion(Eigen::AngleAxisd(t * angle, sweep.turn / angle)) * sweep.rotation;
  }
  return pose;
}

AxisInWorld axisAt(const RigidSweep& sweep, double t) {
  const RigidPose pose = poseAt(sweep, t);
  const Eigen::Matrix3d R_WL = pose.rotation.toRotationMatrix();
  return {pose.pivot + R_WL * sweep.lss_L.a, pose.pivot + R_WL * sweep.lss_L.b};
}

double fastestAxisPoint(const RigidSweep& sweep) {
  const double farthest = std::max(sweep.lss_L.a.norm(), sweep.lss_L.b.norm());
  return (sweep.to - sweep.from).norm() + sweep.turn.norm() * farthest;
}

double displacement(const RigidSweep& sweep, double t0, double t1) {
  const AxisInWorld one = axisAt(sweep, t0), other = axisAt(sweep, t1);
  return std::max((other.a - one.a).norm(), (other.b - one.b).norm());
}

}  // namespace foretouch::tools
