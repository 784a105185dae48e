#include "tests/oracle/world_stage.h"

#include <algorithm>
#include <cmath>

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// All of one object.
Scene sceneOf(std::vector<Triangle> triangles) {
  RawScene raw;
  raw.objectNames = {"prop"};
  raw.objectOf.assign(triangles.size(), 0);
  raw.triangles = std::move(triangles);
  return Scene::build(std::move(raw)).value();
}

}  // namespace

TimedPoses posesOf(const SweepClip& clip, double rateHz, std::int64_t offsetUs,
                   std::int64_t untilUs, const Walk& walk) {
  TimedPoses poses;
  const int stride = strideFor(clip.clip, rateHz);
  const auto periodUs =
      static_cast<std::int64_t>(std::llround(1e6 * clip.clip.frameTimeS * stride));
  std::size_t frame = clip.clip.frames.size() / 2;
  for (std::int64_t us = offsetUs; us < untilUs + periodUs; us += periodUs) {
    Pose pose = clip.clip.frames[frame];
    pose.translations[0] -= clip.standsAt;
    Placement place = walk.place;
    place.position += 1e-6 * static_cast<double>(us) * walk.speed;
    poses.emplace_back(us, placed(clip.avatar.skeleton(), pose, place));
    frame = std::min(frame + static_cast<std::size_t>(stride), clip.clip.frames.size() - 1);
  }
  return poses;
}

void pushAll(BothWorlds& both, BodyId body, const TimedPoses& poses) {
  for (const auto& [us, pose] : poses) both.push(body, us, pose);
}

void rideAll(BothWorlds& both, BodyId body, const Carrier& carrier, const TimedPoses& poses) {
  for (const auto& [us, pose] : poses) {
    if (us == poses.front().first) {
      both.attach(body, carrier, us, pose);
    } else {
      both.push(body, us, pose);
    }
  }
}

void fly(BothWorlds& both, BodyId body, Flight flight, std::int64_t untilUs) {
  for (std::int64_t us = 0; us < untilUs + flight.periodUs; us += flight.periodUs) {
    both.push(body, us, flight.pose);
    flight.pose.translation += flight.stepBy;
    flight.pose.rotation = (flight.pose.rotation * flight.turnBy).normalized();
  }
}

Scene ring(double radius, double height, int segments) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < segments; ++i) {
    const auto at = [&](int k, double y) {
      const double angle = 2.0 * std::acos(-1.0) * k / segments;
      return Vector3d(radius * std::cos(angle), y, radius * std::sin(angle));
    };
    triangles.push_back({{at(i, 0), at(i + 1, 0), at(i + 1, height)}});
    triangles.push_back({{at(i, 0), at(i + 1, height), at(i, height)}});
  }
  return sceneOf(std::move(triangles));
}

Scene sword() {
  const Vector3d tip(0.8, 0, 0), one(0.05, 0.02, 0), other(0.05, -0.02, 0), back(0.05, 0, 0.004);
  return sceneOf({{{tip, one, other}}, {{tip, one, back}}, {{tip, other, back}}});
}

Scene doorPanel(double width, double height) {
  const Vector3d hinge(0, 0, 0), handle(width, 0, 0), above(width, height, 0), top(0, height, 0);
  return sceneOf({{{hinge, handle, above}}, {{hinge, above, top}}});
}

Scene platform(double side) {
  const double h = 0.5 * side;
  const Vector3d a(-h, 0, -h), b(h, 0, -h), c(h, 0, h), d(-h, 0, h);
  return sceneOf({{{a, b, c}}, {{a, c, d}}});
}

Scene sheetStack(double side, int count, double apart) {
  const double h = 0.5 * side;
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const double x = apart * (i - 0.5 * (count - 1));
    const Vector3d a(x, -h, -h), b(x, h, -h), c(x, h, h), d(x, -h, h);
    triangles.push_back({{a, b, c}});
    triangles.push_back({{a, c, d}});
  }
  return sceneOf(std::move(triangles));
}

}  // namespace foretouch::test
