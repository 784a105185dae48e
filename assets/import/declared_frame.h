// assets/import/declared_frame.h: the unit and the up axis that a file declares, from what assimp
// made of it. In foretouch-import only. Not installed.
#pragma once

#include <string_view>

#include <assimp/scene.h>

#include "assets/file_frame.h"

namespace foretouch::internal {

struct ReadFrame {
  double metresPerUnit = 1.0;  ///< To multiply the scene's numbers by.
  FileFrame frame;             ///< The frame of the numbers so multiplied.
};

/// `extensions`: those of the reader that took the file, as assimp lists them.
[[nodiscard]] ReadFrame frameOf(const aiScene& scene, std::string_view extensions);

}  // namespace foretouch::internal
