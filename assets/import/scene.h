// assets/import/scene.h: a scene read with assimp and written to the parent. In
// foretouch-import only. Not installed.
#pragma once

#include <string>

#include "assets/import/protocol.h"

namespace foretouch::internal {

/// Throws Failure (assets/import/assimp.h). False if the parent is gone.
[[nodiscard]] bool sendScene(const std::string& path, ImportWriter& writer);

}  // namespace foretouch::internal
