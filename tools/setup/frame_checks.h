// tools/setup/frame_checks.h: whether units and axes that were given suit the files: checks beside
// those of the place (tools/setup/placement_check.h).
#pragma once

#include <vector>

#include "articulated/clip.h"
#include "assets/file_frame.h"
#include "middleware/scene/scene.h"
#include "tools/setup/placement_check.h"

namespace foretouch::tools {

/// Checks a scene that was read with `frame`: its unit, and its axis.
[[nodiscard]] std::vector<PlacementCheck> sceneFrameChecks(const RawScene& raw,
                                                           const FileFrame& frame);

/// The same for a clip. `isUpright`: its reader has turned it; else the placement turns it by
/// `frame.up`.
[[nodiscard]] std::vector<PlacementCheck> clipFrameChecks(const Clip& clip, const FileFrame& frame,
                                                          bool isUpright);

}  // namespace foretouch::tools
