// assets/import/declared_frame.h: the unit and the up axis that a file declares, from what assimp
// made of it. In foretouch-import only. Not installed.
#pragma once

#include <string_view>

#include "assets/import/assimp.h"

namespace foretouch::internal {

/// Completes the frame and the unit of `file`. `extensions`: those of the reader that took it, as
/// assimp lists them.
void findFrame(std::string_view extensions, AssimpFile& file);

}  // namespace foretouch::internal
