// tools/audit/avatar_files.h: the files of an avatar that is made of a model.
#pragma once

#include <string>

#include "articulated/result.h"
#include "assets/model/model_avatar.h"

namespace foretouch::tools {

/// The file of the links' triangles: beside the avatar file, under its name.
[[nodiscard]] std::string meshPathOf(const std::string& avatarPath);
/// The same file as the avatar file names it: ModelAvatarOptions::meshFile.
[[nodiscard]] std::string meshFileOf(const std::string& avatarPath);

/// Writes the mesh first, so that an avatar file never refers to a missing one. `made` was made
/// with ModelAvatarOptions::meshFile of the same path.
[[nodiscard]] Result<Done> writeModelAvatar(const ModelAvatar& made, const std::string& avatarPath);

}  // namespace foretouch::tools
