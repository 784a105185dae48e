// tools/stream/served_world.h: a service's loaded world: the scene, and one solver per avatar.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "network/stream/person_stream.h"
#include "network/stream/stream_solver.h"
#include "network/world_stream/world_solver.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

struct ServedWorld {
  Scene scene;
  std::vector<StreamSolver> avatars;
  std::vector<PersonStream> persons;
  std::optional<WorldSolver> world;  ///< The one that moves, if asked for: the caller fills it in.
  std::size_t numTriangles = 0;
  std::vector<std::string> remarks;  ///< Tolerated faults: one sentence each.
};

/// Reads and checks all files of the configuration. Errors name the file or option.
[[nodiscard]] Result<ServedWorld> loadServedWorld(const ServeConfig& config);

}  // namespace foretouch::tools
