#include "tools/stream/served_world.h"

#include <utility>

#include "assets/avatar/avatar_file.h"
#include "tools/console.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {
namespace {

Result<StreamSolver> loadAvatar(const ServeConfig& config, const NumberedAvatar& served,
                                const Scene& scene) {
  const auto avatar = readAvatarFile(served.path);
  if (!avatar.ok()) return inFile(avatar.error(), served.path);
  auto query = queryOptionsFor(config.world, served.path, avatar.value(), scene);
  if (!query.ok()) return query.error();
  auto solver = StreamSolver::make(served.id, avatar.value(), scene, query.value(), config.stream);
  if (!solver.ok()) return inFile(solver.error(), served.path);
  return solver;
}

}  // namespace

Result<ServedWorld> loadServedWorld(const ServeConfig& config) {
  const auto scene = loadScene(config.world);
  if (!scene.ok()) return scene.error();
  ServedWorld world{scene.value(), {}, 0, {}};
  world.numTriangles = scene.value().numTriangles();
  if (const std::size_t dropped = scene.value().audit().droppedNonFinite; dropped > 0) {
    world.remarks.push_back(config.world.scenePath + ": " + std::to_string(dropped) +
                            " triangles with a vertex that is not finite were left out");
  }
  for (const NumberedAvatar& served : config.avatars) {
    auto solver = loadAvatar(config, served, scene.value());
    if (!solver.ok()) return solver.error();
    world.avatars.push_back(std::move(solver).value());
  }
  return world;
}

}  // namespace foretouch::tools
