// What the programs here build their small worlds of: boards, balls and smooth movements.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <foretouch/middleware/solid_world/solid_world.h>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace stage {

/// The value, or the end of the program with what was wrong.
template <typename T>
T checked(foretouch::Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

/// Corners of a board with its sides along the axes.
struct Board {
  const char* name;
  Eigen::Vector3d low, high;
};
inline foretouch::Scene sceneOf(const std::vector<Board>& boards) {
  constexpr int kFaces[6][4] = {{0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2},
                                {4, 5, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  foretouch::RawScene raw;
  for (const Board& board : boards) {
    const auto corner = [&](int i) {
      return Eigen::Vector3d(((i & 1) != 0 ? board.high : board.low).x(),
                             ((i & 2) != 0 ? board.high : board.low).y(),
                             ((i & 4) != 0 ? board.high : board.low).z());
    };
    const auto object = static_cast<foretouch::ObjectId>(raw.objectNames.size());
    raw.objectNames.emplace_back(board.name);
    for (const auto& f : kFaces) {
      raw.triangles.push_back({{{corner(f[0]), corner(f[1]), corner(f[2])}}});
      raw.triangles.push_back({{{corner(f[0]), corner(f[2]), corner(f[3])}}});
      raw.objectOf.insert(raw.objectOf.end(), {object, object});
    }
  }
  return checked(foretouch::Scene::build(raw));
}

/// Links that each have a place of their own in the world: so as many roots.
struct Free {
  const char* name;
  foretouch::Lss lss;
};
inline foretouch::Avatar avatarOf(const std::vector<Free>& links) {
  foretouch::RawSkeleton bones;
  std::vector<std::vector<foretouch::Lss>> lss;
  for (const Free& link : links) {
    bones.joints.push_back({link.name, foretouch::kNoParent, Eigen::Vector3d::Zero(),
                            foretouch::Quaternion::Identity()});
    lss.push_back({link.lss});
  }
  return checked(foretouch::Avatar::build(checked(foretouch::Skeleton::build(bones)), lss));
}

/// As openxr.h has them. The axes are ours: metres, +Y up; the quaternion's order is not.
struct XrPosef {
  struct {
    float x, y, z, w;
  } orientation;
  struct {
    float x, y, z;
  } position;
};
struct Located {
  XrPosef pose;
  bool isTracked;  // XR_SPACE_LOCATION_POSITION_TRACKED_BIT, and that of the orientation
};

inline foretouch::RigidPose rigidPoseOf(const XrPosef& pose) {
  const auto& [q, p] = pose;
  return {foretouch::Quaternion(q.w, q.x, q.y, q.z), {p.x, p.y, p.z}};  // OpenXR has w last
}
/// Not turned.
inline foretouch::RigidPose at(double x, double y, double z) {
  return {foretouch::Quaternion::Identity(), {x, y, z}};
}

/// 0 before `begin`, 1 after `end` (seconds), smoothly.
inline double smoothly(double s, double begin, double end) {
  const double t = std::clamp((s - begin) / (end - begin), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// In place of a picture and of sounds: prints what a player of such links meets and leaves, and
/// where all is shown, if wanted: every end of a motion, in seconds since `beginUs`.
struct Screen {
  const foretouch::Avatar& player;
  std::int64_t beginUs;
  bool showsWays = false;
  int met = 0, left = 0, proven = 0;
  std::int64_t lastUs = beginUs;

  void tell(const foretouch::WorldEvent& event, const std::string& other) {
    const bool isEnter = event.kind == foretouch::EventKind::Enter;
    if (!isEnter && event.kind != foretouch::EventKind::Leave) return;
    const bool isTaken = event.cause == foretouch::LeaveCause::NotAsked;
    std::printf("%.6f s: %s %s %s\n", 1e-6 * microsecondsAfter(beginUs, event.time),
                player.skeleton().name(event.a.link).c_str(),
                isEnter   ? "meets"
                : isTaken ? "takes"
                          : "leaves",
                other.c_str());
    (isEnter ? met : left) += 1;
  }
  void place(double us, const char* who, const foretouch::RigidPose& pose) const {
    if (!showsWays) return;
    const Eigen::Vector3d& at = pose.translation;
    const foretouch::Quaternion& q = pose.rotation;
    std::printf("%.6f s: %s at %.9f %.9f %.9f turned %.9f %.9f %.9f %.9f\n",
                1e-6 * (us - static_cast<double>(beginUs)), who, at.x(), at.y(), at.z(), q.w(),
                q.x(), q.y(), q.z());
  }
  void draw(std::int64_t us, const foretouch::SolidBodyTick& body) {
    const foretouch::SolidTick& tick = body.tick;
    const auto from = static_cast<double>(lastUs), to = static_cast<double>(us);
    for (std::size_t i = 0; i <= tick.numWay; ++i) {
      const foretouch::Pose& pose = i < tick.numWay ? tick.way[i] : tick.shown;
      const double at = i < tick.numWay ? from + tick.times[i] * (to - from) : to;
      for (foretouch::LinkId link = 0; link < player.numLinks(); ++link) {
        const auto j = static_cast<std::size_t>(link);
        place(at, player.skeleton().name(link).c_str(), {pose.rotations[j], pose.translations[j]});
      }
    }
    proven += tick.isCertified;
    lastUs = us;
  }
};

}  // namespace stage
