#include "assets/import/side_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "assets/import/text.h"

namespace foretouch::internal {
namespace {

namespace fs = std::filesystem;

fs::path folderOfModel(const std::string& model) {
  const fs::path folder = fs::path(model).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// How far above a URDF file we look for its package; ROS has it one or two folders above.
constexpr int kMostFoldersUp = 6;

/// The package's parent; without a package, the folder above. Empty if that is the root.
fs::path workspaceOf(const fs::path& folder) {
  std::error_code unknown;
  const fs::path own = fs::canonical(folder, unknown);
  if (unknown) return {};
  fs::path wanted = own.parent_path(), up = own;
  for (int i = 0; i < kMostFoldersUp && up != up.parent_path(); ++i, up = up.parent_path()) {
    if (!fs::is_regular_file(up / "package.xml", unknown)) continue;
    wanted = up.parent_path() == up.root_path() ? up : up.parent_path();
    break;
  }
  return wanted == wanted.root_path() ? fs::path() : wanted;
}

bool isBelow(const fs::path& folder, const fs::path& path) {
  auto part = path.begin();
  for (const fs::path& of : folder) {
    if (of.empty()) continue;  // a slash at the end
    if (part == path.end() || *part != of) return false;
    ++part;
  }
  return part != path.end() &&
         std::none_of(part, path.end(), [](const fs::path& p) { return p.string()[0] == '.'; });
}

}  // namespace

std::vector<std::string> foldersBeside(const std::string& model,
                                       const std::vector<std::string>& packagePaths) {
  const fs::path folder = folderOfModel(model);
  std::vector<std::string> folders{folder.string()};
  const std::string extension = lowerExtensionOf(model);
  const bool isUrdf = extension == ".urdf", isMjcf = extension == ".xml" || extension == ".mjcf";
  if (!isUrdf && !isMjcf) return folders;
  folders.insert(folders.end(), packagePaths.begin(), packagePaths.end());
  if (!isUrdf) return folders;
  const fs::path workspace = workspaceOf(folder);
  if (!workspace.empty()) folders.push_back(workspace.string());
  return folders;
}

bool isWithin(const std::vector<std::string>& folders, const std::string& path) {
  std::error_code unknown;
  const fs::path real = fs::canonical(path, unknown);
  if (unknown) return false;
  return std::any_of(folders.begin(), folders.end(), [&](const std::string& folder) {
    const fs::path realFolder = fs::canonical(folder, unknown);
    return !unknown && isBelow(realFolder, real);
  });
}

bool isSideFile(const std::string& model, const std::string& path) {
  constexpr std::array<std::string_view, 4> kExtensions{".bin", ".glbin", ".glbuf", ".mtl"};
  const std::string extension = lowerExtensionOf(path);
  std::error_code unknown;
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end() &&
         fs::is_regular_file(path, unknown) && isWithin({folderOfModel(model).string()}, path);
}

}  // namespace foretouch::internal
