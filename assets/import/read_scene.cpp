// Scenes from files, of models or baked.
#include <utility>

#include "articulated/try.h"
#include "assets/import/baked_scene.h"
#include "assets/import/scene_import.h"
#include "middleware/scene/scene_image.h"

namespace foretouch {

Result<LoadedScene> readScene(const std::string& path, const SceneImportOptions& options) {
  if (internal::isBaked(path)) return internal::readBaked(path, options);
  FORETOUCH_TRY(auto imported, importScene(path, options));
  FORETOUCH_TRY(auto scene, inFile(Scene::build(std::move(imported.scene)), path));
  return LoadedScene{std::move(scene), std::move(imported.report), imported.frame};
}

Result<LoadedScene> bakeScene(const std::string& path, const SceneImportOptions& options,
                              const std::string& bakedPath) {
  if (internal::isBaked(path)) {
    return Error::in(path, ErrorCode::Mismatch, "expected the file of a model: this is baked");
  }
  FORETOUCH_TRY(auto imported, importScene(path, options));
  FORETOUCH_TRY(auto scene, inFile(Scene::build(imported.scene), path));
  FORETOUCH_CHECK(internal::writeBaked(bakedPath, path, imported, scene));
  return LoadedScene{std::move(scene), std::move(imported.report), imported.frame};
}

Result<Done> checkScene(const Scene& scene) {
  return internal::holdsItsTriangles(scene);
}

}  // namespace foretouch
