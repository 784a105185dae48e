// tests/middleware/solid/ball_alone.h: an avatar of one ball, and a square board to go around.
#pragma once

#include <utility>

#include "articulated/avatar.h"
#include "middleware/scene/scene.h"

namespace foretouch::test {

inline Avatar ballAlone(double radius) {
  RawSkeleton raw;
  raw.joints.push_back(
      {"ball", kNoParent, Eigen::Vector3d::Zero(), Quaternion(Quaternion::Identity())});
  const Lss ball{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), radius};
  return Avatar::build(Skeleton::build(raw).value(), {{ball}}).value();
}

inline Pose ballAt(const Eigen::Vector3d& place) {
  Pose pose = restPose(ballAlone(1.0).skeleton());
  pose.translations[0] = place;
  return pose;
}

/// Across z.
inline Scene boardAt(const Eigen::Vector3d& middle, double half) {
  RawScene raw;
  raw.objectNames = {"board"};
  const Eigen::Vector3d x(half, 0, 0), y(0, half, 0);
  raw.triangles.push_back({{middle - x - y, middle + x - y, middle + x + y}});
  raw.triangles.push_back({{middle - x - y, middle + x + y, middle - x + y}});
  raw.objectOf = {0, 0};
  return Scene::build(raw).value();
}

}  // namespace foretouch::test
