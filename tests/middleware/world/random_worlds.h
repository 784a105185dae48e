// tests/middleware/world/random_worlds.h: who moves in random worlds: small bodies whose links turn
// ever on, and meshes that fly and spin, each with a clock of its own.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/avatar_surface.h"
#include "tests/middleware/world/both_worlds.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// Of the windows that most tests ask.
inline constexpr std::int64_t kWindowUs = 120'000;

/// A small body whose links turn ever on, about a place that drifts.
struct Walker {
  Avatar avatar;
  Pose pose;
  Eigen::Vector3d drift;
  std::vector<Quaternion> turns;

  void step(Random& random);
};

[[nodiscard]] Walker randomWalker(Random& random, const Eigen::Vector3d& place, double speed);
[[nodiscard]] Scene randomMesh(Random& random);
/// Triangles in most LSS; every now and then a link has none.
[[nodiscard]] AvatarSurface randomSurface(const Avatar& avatar, Random& random);
/// Poses at the body's own period until `untilUs`.
void walk(BothWorlds& both, BodyId body, Walker& walker, std::int64_t periodUs,
          std::int64_t untilUs, Random& random);
void fly(BothWorlds& both, BodyId body, const Eigen::Vector3d& place, std::int64_t periodUs,
         std::int64_t untilUs, Random& random);
[[nodiscard]] std::int64_t randomPeriod(Random& random);
[[nodiscard]] double randomTolerance(Random& random);

/// Expects that nothing broke the promise.
void add(const BothWorlds& both, WorldTally& sum);

}  // namespace foretouch::test
