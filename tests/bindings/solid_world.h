// tests/bindings/solid_world.h: a bent arm over a table, in C++ and in C, and what it is told to
// do.
#pragma once

#include <cstdint>
#include <foretouch/solid.h>
#include <foretouch/world.h>
#include <memory>
#include <vector>

#include "middleware/solid/solid_avatar.h"
#include "tests/bindings/c_world.h"

namespace foretouch::test {

struct ReleaseSolid {
  void operator()(ft_solid* solid) const { ft_solid_destroy(solid); }
};
using SolidHandle = std::unique_ptr<ft_solid, ReleaseSolid>;

/// Fails the test if it cannot be made.
[[nodiscard]] SolidHandle makeSolid(const SceneHandle& scene, const AvatarHandle& avatar,
                                    const ft_solid_options* options = nullptr);

/// A table at y = 0, `numTiles` squares wide.
[[nodiscard]] RawScene tableScene(int numTiles = 4);
/// Shoulder, elbow and hand in a row along +X from (0, 0.3, 0); the hand ends in a ball.
[[nodiscard]] Avatar armAvatar();
/// The arm as a hand would move it: 0 to 1 presses it into the table, 1 to 2 sweeps it along, 2 to
/// 3 lifts it. `t` beyond that: where it began.
[[nodiscard]] Pose armPose(const Avatar& avatar, double t);

/// A world of both kinds.
struct SolidWorld {
  SolidWorld();
  Avatar avatarOfCxx;
  Scene sceneOfCxx;
  SceneHandle scene;
  AvatarHandle avatar;
};

/// Everything that a tick says, of C: for comparisons.
struct WholeTick {
  ft_solid_tick tick{};
  std::vector<double> rotations, translations;
  std::vector<ft_solid_joint> joints;
  std::vector<ft_solid_contact> contacts;
  std::vector<double> wayTimes, wayRotations, wayTranslations;
};
/// Of the tick that ft_solid_follow() has just filled.
[[nodiscard]] WholeTick wholeTick(const ft_solid* solid, const ft_solid_tick& tick);
/// Of a solid avatar of a solid world.
[[nodiscard]] WholeTick wholeTick(const ft_world* world, std::int32_t body);
void expectSame(const WholeTick& c, const SolidTick& cxx, const Scene& scene);
/// One tick of 1/90 s.
WholeTick follow(ft_solid* solid, const Pose& tracked,
                 const std::vector<std::uint8_t>* isTracked = nullptr);

}  // namespace foretouch::test
