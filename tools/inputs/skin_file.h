// tools/inputs/skin_file.h: the skin of a rigged model as the surface of the avatar made from it.
#pragma once

#include <string>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch::tools {

/// The model's own avatar must have the links of `avatar`:
/// the same names and parents in the same order, rest offsets within a millimetre and rest
/// rotations within a thousandth. Errors name the file, the link and what differs.
[[nodiscard]] Result<SkinnedSurface> loadSkin(const std::string& path,
                                              const SceneImportOptions& import,
                                              const Avatar& avatar);

}  // namespace foretouch::tools
