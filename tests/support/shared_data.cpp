#include "tests/support/shared_data.h"

#include <cstdlib>
#include <filesystem>

namespace foretouch::test {

std::optional<std::string> sharedDataFolder() {
  const char* fromEnvironment = std::getenv("FORETOUCH_DATA");
  const std::filesystem::path folder =
      fromEnvironment != nullptr && *fromEnvironment != '\0'
          ? std::filesystem::path(fromEnvironment)
          : std::filesystem::path(FORETOUCH_SOURCE_DIR).parent_path() / "shared" / "data";
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) return std::nullopt;
  return folder.string();
}

std::optional<std::string> sharedData(const std::string& relativePath) {
  const auto folder = sharedDataFolder();
  if (!folder) return std::nullopt;
  const std::filesystem::path path = std::filesystem::path(*folder) / relativePath;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  return path.string();
}

}  // namespace foretouch::test
