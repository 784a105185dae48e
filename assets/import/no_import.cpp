// A library that was built without the importer (FORETOUCH_IMPORT=OFF): it reads no models and no
// scenes, and says so.
#include "assets/import/baked_scene.h"
#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"

namespace foretouch {
namespace {

Error withoutImporter(const std::string& path) {
  return Error::in(path, ErrorCode::ImportFailed,
                   "expected a library that reads models; this one was built without the importer "
                   "(FORETOUCH_IMPORT=OFF)");
}

}  // namespace

bool internal::notePackagedImporter(const char* /*path*/) {
  return false;
}

std::string importerWeakness() {
  return "";
}

Result<ImportedScene> importScene(const std::string& path, const SceneImportOptions& options) {
  return internal::isBaked(path) ? internal::importBaked(path, options) : withoutImporter(path);
}

Result<Model> importModel(const std::string& path, const ModelImportOptions& /*options*/) {
  return withoutImporter(path);
}

}  // namespace foretouch
