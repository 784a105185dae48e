// assets/import/scene.h: a scene read and written to the parent. In
// foretouch-import only. Not installed.
#pragma once

#include <string>

#include "assets/import/protocol.h"

namespace foretouch::internal {

/// Throws Failure (assets/import/failure.h). False if the parent is gone.
[[nodiscard]] bool sendScene(const std::string& path, ImportWriter& writer);

}  // namespace foretouch::internal
