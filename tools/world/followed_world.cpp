#include "tools/world/followed_world.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/events/world_follower.h"
#include "tools/world/world_windows.h"

namespace foretouch::tools {
namespace {

/// Poses of all bodies that are followed in one go: enough to spread what a call costs.
constexpr std::size_t kPosesPerStretch = 32;

/// The mass of a solid box of triangles, or of the box around a mesh.
Mass massOfBox(const std::vector<Triangle>& triangles, double kg) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles) {
    for (const Eigen::Vector3d& vertex : triangle.vertices) box.extend(vertex);
  }
  constexpr double kOfBox = 1.0 / 12.0;
  const Eigen::Vector3d squares = box.sizes().cwiseAbs2();
  Mass mass;
  mass.kg = kg;
  mass.center_B = box.center();
  mass.inertia_B = Eigen::Vector3d::Constant(kOfBox * kg * squares.sum()).asDiagonal();
  mass.inertia_B.diagonal() -= kOfBox * kg * squares;
  return mass;
}

Result<Done> weigh(const LoadedWorld& world, BodyId id, double kg, WorldFollower& follower) {
  const LoadedBody& body = world.bodies[slotOf(id)];
  if (body.isMesh()) return follower.weigh(id, massOfBox(*body.shape.triangles, kg));
  FORETOUCH_TRY(auto masses, massesOfLinks(*body.shape.avatar, kg));
  if (world.file.bodies[slotOf(id)].shape.avatarPath.empty()) {
    return follower.weigh(id, masses.front());
  }
  FORETOUCH_TRY(auto mass, AvatarMass::build(body.shape.skeleton, std::move(masses)));
  return follower.weigh(id, std::move(mass));
}

Result<Done> weighAll(const LoadedWorld& world, WorldFollower& follower) {
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const FileBody& file = world.file.bodies[i];
    if (!file.massKg) continue;
    const auto refused = [&](const Error& error) {
      return Error::inLine(world.file.path, file.line, error.code,
                           file.title() + " mass: " + error.message);
    };
    FORETOUCH_CHECK_OR(refused, weigh(world, static_cast<BodyId>(i), *file.massKg, follower));
  }
  return Done{};
}

}  // namespace

Result<Done> checkFollowed(const LoadedWorld& world) {
  if (!world.file.askMeshes) return Done{};
  return Error::inLine(world.file.path, -1, ErrorCode::Mismatch,
                       "expected ask_meshes = false: meshes that meet meshes are not followed from "
                       "enter to leave");
}

Result<Done> followWorld(LoadedWorld& world, std::int64_t fromUs, std::int64_t untilUs,
                         const std::function<bool(const FollowedStretch&)>& take) {
  FORETOUCH_CHECK(checkFollowed(world));
  FORETOUCH_TRY(auto follower, WorldFollower::start(fromUs));
  FORETOUCH_CHECK(weighAll(world, follower));
  FORETOUCH_TRY(const auto poses, windowsOf(world, {std::nullopt, fromUs, untilUs}));
  world.triggers.beginAnew();
  const auto inFile = [&](Error error) {
    error = named(std::move(error), world.file);
    error.file = world.file.path;
    return error;
  };
  WorldEvents contacts;
  TriggerEvents triggers;
  for (std::size_t i = 0; i + 1 < poses.size();) {
    i = std::min(i + kPosesPerStretch, poses.size() - 1);
    FORETOUCH_CHECK_OR(inFile, follower.follow(world.world, poses[i], contacts));
    FORETOUCH_CHECK_OR(inFile, world.triggers.update(world.world, contacts, triggers));
    if (!take({contacts, triggers})) break;
  }
  return Done{};
}

}  // namespace foretouch::tools
