// tests/middleware/random_scene.h: cluttered scenes and bodies that move through them.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/scene/scene.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// `count` triangles of very different sizes in a 4 m cube, with slivers, coincident ones and fans
/// that share an edge; `objects` names, around `center`.
RawScene clutter(Random& random, int count, int objects, const Eigen::Vector3d& center);

/// A body of `links` links with one to three LSS each, and a step of it within the clutter.
struct RandomBody {
  Avatar avatar;
  Pose from, to;
  [[nodiscard]] ChainMotion motion() const { return ChainMotion(avatar.skeleton(), from, to); }
};
RandomBody bodyInClutter(Random& random, int links, const Eigen::Vector3d& center);

}  // namespace foretouch::test
