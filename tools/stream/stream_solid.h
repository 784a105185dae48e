// tools/stream/stream_solid.h: the solid avatars of a stream, live or from its log.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/stream/stream_solver.h"
#include "tools/settings/stream_settings.h"

namespace foretouch::tools {

/// As the request says, for an avatar whose query ignores these pairs. Errors name its file.
[[nodiscard]] Result<SolidOptions> solidOptionsFor(const StreamSolidRequest& request,
                                                   const std::string& avatarPath,
                                                   const Avatar& avatar,
                                                   const std::vector<IgnoredPair>& ignored);

/// Makes the solver's avatar solid if the request asks for it. What its query ignores stops no
/// solid avatar. Errors name the avatar's file.
[[nodiscard]] Result<Done> makeSolid(const StreamSolidRequest& request,
                                     const std::string& avatarPath, StreamSolver& solver);

}  // namespace foretouch::tools
