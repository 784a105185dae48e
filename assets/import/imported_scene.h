// assets/import/imported_scene.h: the options and the result of importing a scene, and the places
// where the program that does it is looked for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "assets/file_frame.h"
#include "middleware/scene/raw_scene.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// Where the copy of Foretouch that a program was built against keeps foretouch-import. A static
/// library does not know: its prefix may have been moved, and the program that it is part of lies
/// elsewhere. foretouchConfig.cmake does, and hands it to all that links foretouch::assets, as
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
  std::optional<UpAxis> up;  ///< The file's, in place of what it says.
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

}  // namespace foretouch
