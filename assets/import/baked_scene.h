// assets/import/baked_scene.h: scenes as readScene() leaves them, in one file whose pages queries
// read in place (docs/formats.md, "Baked scenes"). Not installed.
#pragma once

#include <string>

#include "articulated/result.h"
#include "assets/import/imported_scene.h"

namespace foretouch::internal {

/// Is the file a baked scene, by its first bytes?
[[nodiscard]] bool isBaked(const std::string& path);

/// Ready to be asked. Errors: damaged, of another layout, read with other options, or baked from a
/// file beside it that has changed since.
[[nodiscard]] Result<LoadedScene> readBaked(const std::string& path,
                                            const SceneImportOptions& options);

/// The triangles as importScene() had them, each with its vertices in the file's order.
[[nodiscard]] Result<ImportedScene> importBaked(const std::string& path,
                                                const SceneImportOptions& options);

/// `imported` was made from the file `source`, and `scene` from it.
[[nodiscard]] Result<Done> writeBaked(const std::string& path, const std::string& source,
                                      const ImportedScene& imported, const Scene& scene);

}  // namespace foretouch::internal
