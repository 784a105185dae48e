#include "assets/import/scene_import.h"

#include <filesystem>
#include <new>
#include <system_error>

#include "assets/import/baked_scene.h"
#include "assets/import/cage.h"
#include "assets/import/protocol.h"
#include "assets/import/run.h"
#include "assets/import/side_files.h"
#include "assets/import/text.h"
#include "lss/sanitizer.h"

namespace foretouch {
namespace {

using internal::importError;

/// Many formats have no names; a contact should say more than "", so this uses the file's name.
void nameTheNameless(RawScene& scene, const std::string& path) {
  const std::string stem = internal::readableText(std::filesystem::path(path).stem().string(),
                                                  internal::kMaxObjectNameBytes);
  for (std::string& name : scene.objectNames) {
    if (name.empty()) name = stem;
  }
}

/// Metres and +Y up: scale, then turn.
void place(RawScene& scene, const internal::FrameChange& change) {
  for (Triangle& triangle : scene.triangles) {
    for (Eigen::Vector3d& vertex : triangle.vertices) {
      vertex *= change.scale;
      vertex = change.turned(vertex);
    }
  }
}

Result<ImportedScene> importChecked(const std::string& path, const SceneImportOptions& options) {
  internal::ImportReader reader;
  if (const auto error =
          internal::runImporter(path, options, {path}, internal::foldersBeside(path, {}), reader))
    return *error;
  ImportedScene imported = reader.take();
  imported.frame = reader.fileFrame();
  if (imported.scene.triangles.empty()) {
    return importError(path, ErrorCode::Empty,
                       "expected triangles, found none (" +
                           std::to_string(imported.report.skippedPrimitives) +
                           " points and lines, " + std::to_string(imported.report.skippedFaces) +
                           " faces with indices out of range)");
  }
  nameTheNameless(imported.scene, path);
  place(imported.scene, internal::settleFrame(options.scale, options.up, imported.frame));
  return Result<ImportedScene>(std::move(imported));
}

}  // namespace

std::string importerWeakness() {
  return internal::kUnderSanitizer ? "" : internal::weaknessOf(internal::partsOfThisKernel());
}

Result<ImportedScene> importScene(const std::string& path, const SceneImportOptions& options) {
  try {
    return internal::isBaked(path) ? internal::importBaked(path, options)
                                   : importChecked(path, options);
  } catch (const std::bad_alloc&) {
    return importError(path, ErrorCode::LimitExceeded,
                       "not enough memory for the model's triangles");
  } catch (const std::system_error& error) {
    return importError(path, ErrorCode::ImportFailed, error.what());
  }
}

}  // namespace foretouch
