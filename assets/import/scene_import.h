// assets/import/scene_import.h: scenes from model files (docs/formats.md says which), with node
// transforms and instances applied. We do not trust assimp with untrusted files (it aborts or
// crashes on some), so it runs in a child process, `foretouch-import`, under limits of memory, time
// and files, and we check the child's output like any other untrusted data.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/import/imported_scene.h"

namespace foretouch {

/// One object per mesh instance that has triangles, named after its node (its mesh if the node has
/// no name, the file if neither has). Names are UTF-8 without control characters. Triangles in the
/// order of the file: nodes depth first, parents before children. A face of n corners gives n - 2
/// triangles. Does not apply skins and animations; morph targets stand at their default weights
/// where the format has such (glTF). Keeps vertices that are not finite: Scene::build() drops and
/// counts their triangles. Never throws, never crashes with the file, never leaves a child process
/// behind.
[[nodiscard]] Result<ImportedScene> importScene(const std::string& path,
                                                const SceneImportOptions& options = {});

/// From a model's file, or one that bakeScene() wrote: that takes milliseconds and no importer,
/// gives the same answers bit for bit, and where only this user may write the file, all processes
/// that read it share its pages. Errors: as importScene() and Scene::build(); a baked file that is
/// damaged, of another version, read with other options, or older than the model beside it.
[[nodiscard]] Result<LoadedScene> readScene(const std::string& path,
                                            const SceneImportOptions& options = {});

/// Reads the model's file `path` and writes the scene to `bakedPath`: triangles, tree, audit and
/// names, about 150 bytes per triangle. Errors: as readScene(); what cannot be written.
[[nodiscard]] Result<LoadedScene> bakeScene(const std::string& path,
                                            const SceneImportOptions& options,
                                            const std::string& bakedPath);

/// Does a scene's tree hold all of its triangles? readScene() sees that no query leaves the memory
/// of a baked file, and that the file is whole; what a stranger baked may yet hide triangles. O(n).
[[nodiscard]] Result<Done> checkScene(const Scene& scene);

/// The child may read the model, its parts beside it and the system's libraries, and nothing else;
/// it may write nothing, start no program, and reach no other process and no network. Where this
/// kernel lacks what holds it there: in one sentence, what code that a file makes it run could
/// still do. Else empty.
[[nodiscard]] std::string importerWeakness();

}  // namespace foretouch
