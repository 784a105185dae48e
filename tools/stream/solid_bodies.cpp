#include "tools/stream/solid_bodies.h"

#include <algorithm>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "tools/inputs/name_pattern.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/stream/stream_solid.h"

namespace foretouch::tools {
namespace {

Error atChange(const WorldFile& file, const FileChange& change, const std::string& what) {
  return Error::inLine(file.path, change.line, ErrorCode::Mismatch,
                       what +
                           "; expected that a solid body of a service carries nothing and is "
                           "not carried");
}

Result<Done> checkedCarriers(const WorldFile& file, const FileBody& solid) {
  for (const FileBody& body : file.bodies) {
    for (const FileChange& change : body.changes) {
      if (!change.isAttached || (body.name != solid.name && change.carrier != solid.name)) continue;
      return atChange(file, change, inQuotes(change.carrier) + " carries " + inQuotes(body.name));
    }
  }
  return Done{};
}

Result<Done> makeSolidBody(const LoadedWorld& world, const WorldRequest& query,
                           const StreamSolidRequest& request, WorldSetup& setup,
                           WorldSetup::ServedAvatar& served) {
  const FileBody& body = world.file.bodies[served.shape];
  const std::string& path = body.shape.avatarPath;
  const Avatar& avatar = *setup.shapes[served.shape].avatar;
  FORETOUCH_CHECK(checkedCarriers(world.file, body));
  FORETOUCH_TRY(const auto options, queryOptionsFor(query, path, avatar, *world.scene));
  FORETOUCH_TRY(served.solid, solidOptionsFor(request, path, avatar, options.ignored));
  return Done{};
}

}  // namespace

Result<Done> makeSolidBodies(const LoadedWorld& world, const WorldRequest& query,
                             const StreamSolidRequest& request, WorldSetup& setup) {
  if (!request.solid.isAsked) return Done{};
  for (const std::string& pattern : request.worldBodies) {
    bool isAny = false;
    for (WorldSetup::ServedAvatar& served : setup.avatars) {
      if (!matches(pattern, world.file.bodies[served.shape].name)) continue;
      isAny = true;
      FORETOUCH_CHECK(makeSolidBody(world, query, request, setup, served));
    }
    if (isAny) continue;
    return Error::in("--world-solid", ErrorCode::UnknownName,
                     "expected the name of a body with an avatar in " + world.file.path +
                         ", found " + inQuotes(pattern));
  }
  return Done{};
}

}  // namespace foretouch::tools
