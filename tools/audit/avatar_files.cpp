#include "tools/audit/avatar_files.h"

#include <filesystem>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/mesh/link_mesh.h"
#include "assets/text_file.h"

namespace foretouch::tools {

std::string meshPathOf(const std::string& avatarPath) {
  return std::filesystem::path(avatarPath).replace_extension(".mesh.glb").string();
}

std::string meshFileOf(const std::string& avatarPath) {
  return std::filesystem::path(meshPathOf(avatarPath)).filename().string();
}

Result<Done> writeModelAvatar(const ModelAvatar& made, const std::string& avatarPath) {
  FORETOUCH_CHECK(PendingFile::create(avatarPath));
  if (made.report.triangles > 0) {
    FORETOUCH_CHECK(writeLinkMeshes(made.avatar.skeleton(), made.surface, meshPathOf(avatarPath)));
  }
  FORETOUCH_CHECK(writeAvatarFile(made.avatar, avatarPath));
  return Done{};
}

}  // namespace foretouch::tools
