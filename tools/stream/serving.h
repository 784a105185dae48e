// tools/stream/serving.h: a world file as a service takes it: its scene and avatars, and the world
// that moves. The service and the replay of its log load the same.
#pragma once

#include <string>
#include <vector>

#include "network/world_stream/world_solver.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

struct WorldToServe {
  WorldSolver solver;
  std::vector<NumberedAvatar> avatars;
  std::vector<std::string> remarks;  ///< A sentence each.
};

/// Sets the scene of `request`. `solid`: which of the avatars are solid among all that moves.
/// Errors name the file and the place in it: one without a scene, or without an avatar; those of
/// loadWorld(), makeSolidBodies() and WorldSolver::make().
[[nodiscard]] Result<WorldToServe> loadWorldToServe(const std::string& path,
                                                    const WorldPolicy& policy,
                                                    const StreamSolidRequest& solid,
                                                    WorldRequest& request);

}  // namespace foretouch::tools
