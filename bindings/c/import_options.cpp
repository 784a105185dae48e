#include "bindings/c/import_options.h"

#include <cstdlib>
#include <string>

#include "bindings/c/importer_place.h"

namespace foretouch::c {
namespace {

std::string importerPlace(const char* named) {
  if (named != nullptr && *named != '\0') return named;
  const char* const ofEnvironment = std::getenv("FORETOUCH_IMPORTER");
  if (ofEnvironment != nullptr && *ofEnvironment != '\0') return "";  // importScene() heeds it
  return importerNearLibrary();
}

}  // namespace

ft_import_options defaultImportOptions() {
  const SceneImportOptions defaults;
  ft_import_options options{};
  options.size = sizeof options;
  options.up = FT_UP_FILE;
  options.scale = 0.0;
  options.memory_limit_bytes = defaults.memoryLimitBytes;
  options.time_limit_s = defaults.timeLimitS;
  return options;
}

ft_status readUpAxis(std::int32_t given, std::optional<UpAxis>& up) {
  if (given == FT_UP_FILE) return FT_OK;
  if (given != FT_UP_Y && given != FT_UP_Z) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "up: expected FT_UP_FILE, FT_UP_Y or FT_UP_Z, found %d", given);
  }
  up = given == FT_UP_Z ? UpAxis::Z : UpAxis::Y;
  return FT_OK;
}

ft_status readImportOptions(const ft_import_options* given, SceneImportOptions& options) {
  ft_import_options known = defaultImportOptions();
  if (given != nullptr) {
    if (const auto status = readStruct(given, "ft_import_options", known); status != FT_OK) {
      return status;
    }
  }
  if (const auto status = readUpAxis(known.up, options.up); status != FT_OK) return status;
  if (known.scale != 0.0) options.scale = known.scale;
  options.memoryLimitBytes = known.memory_limit_bytes;
  options.timeLimitS = known.time_limit_s;
  options.importer = importerPlace(known.importer);
  return FT_OK;
}

}  // namespace foretouch::c

ft_status ft_import_options_init(ft_import_options* options, size_t size) {
  return foretouch::c::initStruct(__func__, options, size, "ft_import_options",
                                  foretouch::c::defaultImportOptions());
}
