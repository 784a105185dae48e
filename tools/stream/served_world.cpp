#include "tools/stream/served_world.h"

#include <utility>

#include "assets/avatar/avatar_file.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

Result<StreamSolver> loadAvatar(const ServeConfig& config, const ServedAvatar& served,
                                const Scene& scene) {
  const auto avatar = readAvatarFile(served.file);
  if (!avatar.ok()) return inFile(avatar.error(), served.file);
  auto query = queryOptionsFor(asReplay(config, served.file), avatar.value(), scene);
  if (!query.ok()) return query.error();
  auto solver = StreamSolver::make(served.id, avatar.value(), scene, query.value(), config.stream);
  if (!solver.ok()) return inFile(solver.error(), served.file);
  return solver;
}

}  // namespace

ReplayRequest asReplay(const ServeConfig& config, const std::string& avatarPath) {
  ReplayRequest request;
  request.scenePath = config.scene;
  request.sceneScale = config.sceneScale;
  request.sceneUp = config.sceneUp;
  request.avatarPath = avatarPath;
  request.tolerance = config.tolerance;
  request.fidelity = config.fidelity;
  request.ignore = config.ignore;
  request.policies = config.policies;
  request.budgetUs = config.budgetUs;
  return request;
}

Result<ServedWorld> loadServedWorld(const ServeConfig& config) {
  const auto scene = loadScene(asReplay(config, std::string()));
  if (!scene.ok()) return scene.error();
  ServedWorld world{scene.value(), {}, 0, {}};
  world.numTriangles = scene.value().numTriangles();
  if (const std::size_t dropped = scene.value().audit().droppedNonFinite; dropped > 0) {
    world.remarks.push_back(config.scene + ": " + std::to_string(dropped) +
                            " triangles with a vertex that is not finite were left out");
  }
  for (const ServedAvatar& served : config.avatars) {
    auto solver = loadAvatar(config, served, scene.value());
    if (!solver.ok()) return solver.error();
    world.avatars.push_back(std::move(solver).value());
  }
  return world;
}

}  // namespace foretouch::tools
