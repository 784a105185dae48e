// tools/stream/served_world.h: what a service answers about, loaded: the scene, and a solver an
// avatar.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "network/stream/stream_solver.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

struct ServedWorld {
  Scene scene;
  std::vector<StreamSolver> avatars;
  std::size_t numTriangles = 0;
  std::vector<std::string> remarks;  ///< What was tolerated: one sentence each.
};

/// Reads and checks all that the configuration names. Errors name the file or option.
[[nodiscard]] Result<ServedWorld> loadServedWorld(const ServeConfig& config);

}  // namespace foretouch::tools
