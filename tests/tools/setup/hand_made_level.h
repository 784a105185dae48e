// tests/tools/setup/hand_made_level.h: rooms of a few boxes, and a body of two legs and a trunk.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "middleware/scene/scene.h"
#include "tools/setup/walker.h"

namespace foretouch::test {

/// Adds an axis-aligned rectangle: `corner` and two edges; its front is along edge1 x edge2.
inline void addRectangle(RawScene& raw, const Eigen::Vector3d& corner, const Eigen::Vector3d& edge1,
                         const Eigen::Vector3d& edge2, const std::string& name = "room") {
  const Eigen::Vector3d b = corner + edge1, c = corner + edge1 + edge2, d = corner + edge2;
  raw.triangles.push_back({{corner, b, c}});
  raw.triangles.push_back({{corner, c, d}});
  if (raw.objectNames.empty() || raw.objectNames.back() != name) raw.objectNames.push_back(name);
  const auto object = static_cast<ObjectId>(raw.objectNames.size() - 1);
  raw.objectOf.insert(raw.objectOf.end(), 2, object);
}

/// A room of 8 x 3 x 6 m around the middle of its floor, seen from inside, times `unit`.
inline RawScene room(double unit = 1.0) {
  RawScene raw;
  const double x = 4.0 * unit, y = 3.0 * unit, z = 3.0 * unit;
  addRectangle(raw, {-x, 0, -z}, {0, 0, 2 * z}, {2 * x, 0, 0});  // floor, front up
  addRectangle(raw, {-x, y, -z}, {2 * x, 0, 0}, {0, 0, 2 * z});  // ceiling, front down
  addRectangle(raw, {-x, 0, -z}, {2 * x, 0, 0}, {0, y, 0});
  addRectangle(raw, {-x, 0, z}, {0, y, 0}, {2 * x, 0, 0});
  addRectangle(raw, {-x, 0, -z}, {0, y, 0}, {0, 0, 2 * z});
  addRectangle(raw, {x, 0, -z}, {0, 0, 2 * z}, {0, y, 0});
  return raw;
}

/// (x, y, z) as a file with z up has it: (x, -z, y).
inline RawScene zUp(RawScene raw) {
  for (Triangle& triangle : raw.triangles) {
    for (Eigen::Vector3d& v : triangle.vertices) v = Eigen::Vector3d(v.x(), -v.z(), v.y());
  }
  return raw;
}

/// Hips at 0.9 m, knees and ankles below, a head above: 1.7 m tall, its lowest point at 0.
inline RawSkeleton standingBones(double unit = 1.0) {
  RawSkeleton bones;
  const auto add = [&](const char* name, JointId parent, double x, double y) {
    bones.joints.push_back({name, parent, Eigen::Vector3d(x, y, 0) * unit, Quaternion::Identity()});
  };
  add("Hips", kNoParent, 0, 0.9);
  add("LeftUpLeg", 0, 0.1, 0);
  add("LeftLeg", 1, 0, -0.42);
  add("LeftFoot", 2, 0, -0.42);
  add("RightUpLeg", 0, -0.1, 0);
  add("RightLeg", 4, 0, -0.42);
  add("RightFoot", 5, 0, -0.42);
  add("Spine", 0, 0, 0.3);
  add("Head", 7, 0, 0.35);
  return bones;
}

inline Avatar standingAvatar() {
  std::vector<std::vector<Lss>> lss(9);
  lss[0] = {{{0, 0, 0}, {0, 0, 0}, 0.15}};
  for (const std::size_t leg : {std::size_t{1}, std::size_t{2}, std::size_t{4}, std::size_t{5}}) {
    lss[leg] = {{{0, 0, 0}, {0, -0.42, 0}, 0.06}};
  }
  for (const std::size_t foot : {std::size_t{3}, std::size_t{6}}) {
    lss[foot] = {{{0, 0, 0}, {0, 0, 0.15}, 0.06}};
  }
  lss[7] = {{{0, 0, 0}, {0, 0.3, 0}, 0.15}};
  lss[8] = {{{0, 0, 0}, {0, 0.1, 0}, 0.1}};
  return Avatar::build(Skeleton::build(standingBones()).value(), lss).value();
}

/// The avatar at rest, moved by each of `moves`.
inline tools::WalkingBody walking(const std::vector<Eigen::Vector3d>& moves) {
  tools::WalkingBody body{standingAvatar(), {}};
  const Pose rest = restPose(body.avatar.skeleton());
  for (const Eigen::Vector3d& move : moves) {
    body.poses.push_back(placed(body.avatar.skeleton(), rest, {false, move, 0.0}));
  }
  return body;
}

/// A clip of one frame: the bones at rest, in `unit`s of a metre, with y or z up.
inline Clip clipOf(double unit, bool isZUp = false) {
  Clip clip;
  clip.skeleton = Skeleton::build(standingBones(1.0 / unit)).value();
  clip.frameTimeS = 0.1;
  Pose pose = restPose(clip.skeleton);
  if (isZUp) {
    pose.rotations[0] = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitX());
  }
  clip.frames = {pose};
  clip.hasTranslation.assign(9, false);
  clip.hasRotation.assign(9, true);
  clip.endSites.resize(9);
  return clip;
}

}  // namespace foretouch::test
