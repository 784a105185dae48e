// tests/tools/small_inputs.h: the small world as inputs in memory, without any file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "tests/tools/small_world.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::test {

/// A rectangle in the plane x = `x`, from -2 to 2 in y and z.
inline RawScene wallAt(double x, const std::string& name) {
  const Eigen::Vector3d a(x, -2, -2), b(x, 2, -2), c(x, 2, 2), d(x, -2, 2);
  return {{Triangle{{a, b, c}}, Triangle{{a, c, d}}}, {0, 0}, {name}};
}

inline tools::ReplayInputs smallInputs(const std::vector<double>& places,
                                       const Eigen::Vector3d& origin = Eigen::Vector3d::Zero(),
                                       const std::string& wall = "wall") {
  Avatar avatar = parseAvatar(kManAvatar, "man.json").value();
  Clip clip = parseBvh(clipAlongX(places), "clip.bvh").value();
  JointMatch match = matchJoints(avatar.skeleton(), clip.skeleton).value();
  tools::ReplayRequest request;
  request.scenePath = "some/wall.obj";
  request.avatarPath = "some/man.json";
  request.motionPath = "some/clip.bvh";
  request.placement.origin = origin;
  const auto steps = tools::selectSteps(clip, std::nullopt).value();
  return {request,           Scene::build(wallAt(0.0, wall)).value(),
          std::move(avatar), std::move(clip),
          std::move(match),  steps,
          QueryOptions{}};
}

/// A line of results without its latency fields.
inline std::string withoutLatency(std::string line) {
  const std::size_t field = line.find(",\"latency_us\":");
  if (field == std::string::npos) return line;
  return line.erase(field, line.find('}', field) - field);
}

}  // namespace foretouch::test
