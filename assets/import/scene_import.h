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
#include "assets/file_frame.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// Where the copy of Foretouch that a program was built against keeps foretouch-import. A static
/// library does not know: its prefix may have been moved, and the program that it is part of lies
/// elsewhere. foretouchConfig.cmake does, and says it to everybody who links foretouch::assets, as
/// FORETOUCH_PACKAGED_IMPORTER.
/// Adds a place to those where the importer is looked for. `path` must live as long as the program.
bool notePackagedImporter(const char* path);

#ifdef FORETOUCH_PACKAGED_IMPORTER
inline const bool kPackagedImporterIsNoted = notePackagedImporter(FORETOUCH_PACKAGED_IMPORTER);
#endif

}  // namespace foretouch::internal

namespace foretouch {

struct SceneImportOptions {
  /// Metres per unit of the file, in place of what the file says. Finite, > 0.
  std::optional<double> scale;
  std::optional<UpAxis> up;  ///< Of the file, in place of what it says.
  /// Address space of the child. At most half of the machine's memory is used, or of what a control
  /// group (a container) allows this process; and for a small file no more than 1 GB: 990 MB, and
  /// 256 bytes for each byte that is read.
  std::size_t memoryLimitBytes = std::size_t{8} << 30;
  double timeLimitS = 60.0;  ///< Wall and CPU time of the child.
  std::string importer;  ///< Path of foretouch-import; empty: $FORETOUCH_IMPORTER, else beside the
                         ///< running program, else where the package that it was built against
                         ///< has it, else at its installation path.
};

/// The file's content besides triangles.
struct SceneImportReport {
  std::size_t nodes = 0;          ///< Nodes of the file's tree.
  std::size_t meshInstances = 0;  ///< Placements of meshes by nodes.
  std::size_t uniqueMeshes = 0;
  std::size_t skippedPrimitives = 0;  ///< Points and lines, once per placement: they have no
                                      ///< surface.
  std::size_t skippedFaces = 0;       ///< Faces with vertex indices out of range, once per
                                      ///< placement.
  /// What the file has and its reader left out, one sentence each. Bounded in number.
  std::vector<std::string> notes;
};

struct ImportedScene {
  RawScene scene;
  SceneImportReport report;
  FileFrame frame;
};

/// A scene that is ready to be asked, and what was said of its file.
struct LoadedScene {
  Scene scene;
  SceneImportReport report;
  FileFrame frame;
};

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
