// tests/bench/world.h: the small world as a benchmark's inputs.
#pragma once

#include <utility>
#include <vector>

#include "bench/inputs.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::test {

/// The man of small_world.h goes to the given places along x; a wall stands at x = 0.
inline tools::BenchInputs benchInputs(const std::vector<double>& places) {
  RawScene raw = wallAt(0.0, "wall");
  Scene scene = Scene::build(raw).value();
  Avatar avatar = parseAvatar(kManAvatar, "man.json").value();
  Clip clip = parseBvh(clipAlongX(places), "clip.bvh").value();
  JointMatch match = matchJoints(avatar.skeleton(), clip.skeleton).value();
  return {
      {},   std::move(raw), std::move(scene), std::move(avatar), std::move(clip), std::move(match),
      false};
}

}  // namespace foretouch::test
