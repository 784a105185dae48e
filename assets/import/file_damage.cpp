#include "assets/import/file_damage.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>

#include "assets/import/glb_damage.h"

namespace foretouch::internal {
namespace {

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

std::optional<std::string> damageOf(const std::string& path) {
  try {
    const std::string extension = extensionOf(path);
    std::string damage;
    if (extension == ".glb") damage = damageOfGlb(path);
    if (extension == ".gltf") damage = damageOfGltf(path);
    if (!damage.empty()) return damage;
  } catch (const std::exception&) {
    // Out of memory, say: the reader's own reason has to do.
  }
  return std::nullopt;
}

std::optional<std::string> hopelessDamageOf(const std::string& path) {
  try {
    if (extensionOf(path) == ".glb" && isGlbWithoutItsJson(path)) return damageOf(path);
  } catch (const std::exception&) {
    // Not readable: for the reader to say.
  }
  return std::nullopt;
}

}  // namespace foretouch::internal
