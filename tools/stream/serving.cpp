#include "tools/world/serving.h"

#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/world/load_world.h"
#include "tools/world/served_bodies.h"

namespace foretouch::tools {

Result<WorldToServe> loadWorldToServe(const std::string& path, const WorldPolicy& policy,
                                      WorldRequest& request) {
  FORETOUCH_TRY(auto parsed, readWorldFile(path));
  FORETOUCH_TRY(const auto loaded, loadWorld(std::move(parsed)));
  const WorldFile& file = loaded.file;
  if (file.scene.scenePath.empty()) {
    return Error::inLine(file.path, -1, ErrorCode::Empty,
                         "expected a [scene]: every pose is answered about it");
  }
  request.scenePath = file.scene.scenePath;
  request.sceneImport = file.scene.sceneImport;
  std::vector<NumberedAvatar> avatars;
  for (std::size_t i = 0; i < file.bodies.size(); ++i) {
    const std::string& avatar = file.bodies[i].shape.avatarPath;
    if (!avatar.empty()) avatars.push_back({numberInMessages(i), avatar});
  }
  if (avatars.empty()) {
    return Error::inLine(file.path, -1, ErrorCode::Empty,
                         "expected a [[body]] with an avatar: poses are answered for avatars");
  }
  FORETOUCH_TRY(auto solver, inFile(WorldSolver::make(servedBodies(loaded), policy), path));
  return WorldToServe{std::move(solver), std::move(avatars), remarksOnServing(loaded)};
}

}  // namespace foretouch::tools
