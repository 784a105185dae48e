#include "tools/served_world.h"

#include <utility>

#include "articulated/avatar_file.h"
#include "middleware/link_mesh.h"
#include "middleware/scene_import.h"
#include "network/work_budget.h"
#include "tools/console.h"
#include "tools/ignored_pairs.h"

namespace foretouch::tools {
namespace {

Result<Scene> loadScene(const ServeConfig& config) {
  SceneImportOptions options;
  options.scale = config.sceneScale;
  options.up = config.sceneUp;
  auto imported = importScene(config.scene, options);
  if (!imported.ok()) return inFile(imported.error(), config.scene);
  auto scene = Scene::build(std::move(imported.value().scene));
  if (!scene.ok()) return inFile(scene.error(), config.scene);
  return scene;
}

/// What the avatar's queries are asked with.
Result<QueryOptions> queryOf(const ServeConfig& config, const Avatar& avatar,
                             const std::string& path, const Scene& scene) {
  QueryOptions query;
  query.tolerance = config.tolerance;
  query.fidelity = config.fidelity;
  if (config.budgetUs > 0) {
    query.workBudget = workBudget(static_cast<double>(config.budgetUs));
  }
  auto ignored = parseIgnoredPairs(config.ignore, avatar.skeleton(), scene.objectNames());
  if (!ignored.ok()) return ignored.error();
  query.ignored = std::move(ignored).value();
  if (config.fidelity != Fidelity::Exact) return query;
  auto meshes = loadLinkMeshes(avatar, path);
  if (!meshes.ok()) return inFile(meshes.error(), path);
  auto surface = AvatarSurface::build(avatar, std::move(meshes).value());
  if (!surface.ok()) return inFile(surface.error(), path);
  surface.value().prepare();  // the first pose is not to wait for it
  query.surface = std::move(surface).value();
  return query;
}

Result<StreamSolver> loadAvatar(const ServeConfig& config, const ServedAvatar& served,
                                const Scene& scene) {
  const auto avatar = readAvatarFile(served.file);
  if (!avatar.ok()) return inFile(avatar.error(), served.file);
  const auto query = queryOf(config, avatar.value(), served.file, scene);
  if (!query.ok()) return query.error();
  auto solver = StreamSolver::make(served.id, avatar.value(), scene, query.value(), config.stream);
  if (!solver.ok()) return inFile(solver.error(), served.file);
  return solver;
}

}  // namespace

Result<ServedWorld> loadServedWorld(const ServeConfig& config) {
  const auto scene = loadScene(config);
  if (!scene.ok()) return scene.error();
  ServedWorld world;
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
