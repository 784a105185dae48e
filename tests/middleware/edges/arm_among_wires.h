// tests/middleware/edges/arm_among_wires.h: a planar arm that moves by joint coordinates, among
// wires, with the judge's copy of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "articulated/robot.h"
#include "articulated/skeleton.h"
#include "judge/first_touch.h"
#include "middleware/scene/scene.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// A planar arm about z: three links of 0.4 m along x, radius 0.03.
inline Robot arm(double lower = -7.0, double upper = 7.0) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  std::vector<RobotJoint> joints;
  for (int i = 0; i < 3; ++i) {
    raw.joints.push_back({"j" + std::to_string(i), i - 1, Eigen::Vector3d(i == 0 ? 0.0 : 0.4, 0, 0),
                          Quaternion::Identity()});
    lss.push_back({{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.4, 0, 0), 0.03}});
    RobotJoint joint;
    joint.kind = RobotJointKind::Revolute;
    joint.lower = lower;
    joint.upper = upper;
    joints.push_back(joint);
  }
  auto avatar = Avatar::build(Skeleton::build(raw).value(), lss);
  return Robot::build(avatar.value(), joints).value();
}

/// Coordinates of so many random configurations of it, one after another.
inline std::vector<double> randomConfigurations(unsigned seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  std::vector<double> q;
  for (std::size_t i = 0; i < 3 * count; ++i) q.push_back(angle(random));
  return q;
}

/// A wire across the plane at (x, y), as one thin triangle.
inline void addWire(double x, double y, RawScene& raw, std::vector<oracle::Triangle>& judged) {
  const Triangle wire{Eigen::Vector3d(x, y, -1), Eigen::Vector3d(x, y, 1),
                      Eigen::Vector3d(x + 0.002, y, 1)};
  raw.triangles.push_back(wire);
  raw.objectOf.push_back(0);
  judged.push_back(
      {oracle::Vec3d(x, y, -1), oracle::Vec3d(x, y, 1), oracle::Vec3d(x + 0.002, y, 1)});
}

struct Place {
  Scene scene;
  oracle::Scene judged;
};

inline Place wires(const std::vector<std::pair<double, double>>& at) {
  RawScene raw;
  raw.objectNames = {"wires"};
  std::vector<oracle::Triangle> judged;
  for (const auto& [x, y] : at) addWire(x, y, raw, judged);
  return {Scene::build(raw).value(), oracle::Scene(judged)};
}

/// The least separation of the arm, by sines and the judge's own distance.
inline double separationOf(const oracle::Scene& scene, const std::vector<double>& q) {
  double x = 0, y = 0, angle = 0, least = 10.0;
  for (const double turn : q) {
    angle += turn;
    const oracle::Vec3d a(x, y, 0.0);
    x += 0.4 * std::cos(angle);
    y += 0.4 * std::sin(angle);
    least = std::min(least, oracle::distanceTo(scene, a, oracle::Vec3d(x, y, 0.0), 10.0) - 0.03);
  }
  return least;
}

}  // namespace foretouch::test
