// assets/import/run.h: runs foretouch-import, from options to answer or error: shared by the import
// of scenes and of models. Not installed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/import/imported_scene.h"
#include "assets/import/stream.h"

namespace foretouch::internal {

/// An error about the imported file.
[[nodiscard]] Error importError(const std::string& path, ErrorCode code, std::string message);

/// Where foretouch-import is, by the options, the environment and the running program; an error
/// names the places that were tried.
[[nodiscard]] Result<std::string> findImporter(const std::string& path,
                                               const SceneImportOptions& options);

/// Checks the options and that `path` is a file with an extension, finds the importer, and runs it
/// with `arguments` (which name the path too) in a cage where it can read `path` and what is in
/// `folders` (assets/import/cage.h), feeding `reader`. Nothing if the answer is complete. May throw
/// std::bad_alloc and std::system_error.
[[nodiscard]] std::optional<Error> runImporter(const std::string& path,
                                               const SceneImportOptions& options,
                                               const std::vector<std::string>& arguments,
                                               const std::vector<std::string>& folders,
                                               FrameReader& reader);

}  // namespace foretouch::internal
