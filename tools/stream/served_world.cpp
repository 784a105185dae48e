#include "tools/stream/served_world.h"

#include <utility>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "tools/console.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/stream/stream_person.h"
#include "tools/stream/stream_solid.h"

namespace foretouch::tools {
namespace {

Result<StreamSolver> loadAvatar(const ServeConfig& config, const NumberedAvatar& served,
                                const Scene& scene) {
  FORETOUCH_TRY(const auto avatar, readAvatarFile(served.path));
  FORETOUCH_TRY(auto query, queryOptionsFor(config.world, served.path, avatar, scene));
  FORETOUCH_TRY(
      auto solver,
      inFile(StreamSolver::make(served.id, avatar, scene, query, config.stream), served.path));
  if (!served.isSolidInWorld) FORETOUCH_CHECK(makeSolid(config.solid, served.path, solver));
  return solver;
}

}  // namespace

Result<ServedWorld> loadServedWorld(const ServeConfig& config) {
  FORETOUCH_TRY(const auto scene, loadScene(config.world));
  ServedWorld world{scene, {}, {}, std::nullopt, 0, {}};
  world.numTriangles = scene.numTriangles();
  if (const std::size_t dropped = scene.audit().droppedNonFinite; dropped > 0) {
    world.remarks.push_back(config.world.scenePath + ": " + std::to_string(dropped) +
                            " triangles with a vertex that is not finite were left out");
  }
  for (const NumberedAvatar& served : config.avatars) {
    FORETOUCH_TRY(auto solver, loadAvatar(config, served, scene));
    for (const auto& remark : {remarkOnMeshes(solver.options(), served.path),
                               remarkOnVolume(solver.avatar(), served.path, false)}) {
      if (remark) world.remarks.push_back(*remark);
    }
    world.avatars.push_back(std::move(solver));
  }
  FORETOUCH_TRY(auto persons, makePersons(config.person, world.avatars, scene));
  world.persons = std::move(persons);
  return world;
}

}  // namespace foretouch::tools
