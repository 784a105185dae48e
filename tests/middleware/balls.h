// tests/middleware/balls.h: bodies of one link, the plainest that a world can hold, and their
// places.
#pragma once

#include <vector>

#include "articulated/avatar.h"

namespace foretouch::test {

inline Avatar bodyOf(const std::vector<Lss>& lss) {
  RawSkeleton raw;
  raw.joints = {{"body", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(), {lss}).value();
}
inline Avatar ball(double radius) {
  return bodyOf({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), radius}});
}
inline RigidPose at(double x, double y = 0.0, double z = 0.0) {
  return {Quaternion::Identity(), Eigen::Vector3d(x, y, z)};
}

}  // namespace foretouch::test
