#include "tools/stream/serving.h"

#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/stream/solid_bodies.h"
#include "tools/world/load_world.h"
#include "tools/world/served_bodies.h"

namespace foretouch::tools {

Result<WorldToServe> loadWorldToServe(const std::string& path, const WorldPolicy& policy,
                                      const StreamSolidRequest& solid, WorldRequest& request) {
  FORETOUCH_TRY(auto parsed, readWorldFile(path));
  FORETOUCH_TRY(const auto loaded, loadWorld(std::move(parsed)));
  const WorldFile& file = loaded.file;
  if (file.scene.scenePath.empty()) {
    return Error::inLine(file.path, -1, ErrorCode::Empty,
                         "expected a [scene]: every pose is answered about it");
  }
  request.scenePath = file.scene.scenePath;
  request.sceneImport = file.scene.sceneImport;
  WorldSetup setup = servedBodies(loaded);
  FORETOUCH_CHECK(makeSolidBodies(loaded, request, solid, setup));
  std::vector<NumberedAvatar> avatars;
  for (const WorldSetup::ServedAvatar& avatar : setup.avatars) {
    avatars.push_back(
        {avatar.number, file.bodies[avatar.shape].shape.avatarPath, avatar.solid.has_value()});
  }
  if (avatars.empty()) {
    return Error::inLine(file.path, -1, ErrorCode::Empty,
                         "expected a [[body]] with an avatar: poses are answered for avatars");
  }
  FORETOUCH_TRY(auto solver, inFile(WorldSolver::make(std::move(setup), policy), path));
  return WorldToServe{std::move(solver), std::move(avatars), remarksOnServing(loaded)};
}

}  // namespace foretouch::tools
