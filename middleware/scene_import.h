// middleware/scene_import.h: scenes from model files: every mesh format that assimp reads, with
// node transforms and instances applied. assimp is not trusted with untrusted files (it aborts or
// crashes on some), so it runs in a child process, `foretouch-import`, under limits of memory, time
// and files; what the child hands back is checked like any other untrusted data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "articulated/result.h"
#include "middleware/scene.h"

namespace foretouch {

enum class UpAxis : std::uint8_t { Y, Z };

struct SceneImportOptions {
  double scale = 1.0;     ///< Metres per unit of what assimp hands over. Finite, > 0.
  UpAxis up = UpAxis::Y;  ///< Z: turned in, (x,y,z) becomes (x,z,-y). Scale and turn commute.
  std::size_t memoryLimitBytes = std::size_t{8} << 30;  ///< Address space of the child.
  double timeLimitS = 300.0;                            ///< Wall and CPU time of the child.
  std::string importer;  ///< Path of foretouch-import; empty: $FORETOUCH_IMPORTER, else beside the
                         ///< running program, else where it was installed.
};

/// What the file held besides triangles.
struct SceneImportReport {
  std::size_t nodes = 0;          ///< Nodes of the file's tree.
  std::size_t meshInstances = 0;  ///< Placements of meshes by nodes.
  std::size_t uniqueMeshes = 0;
  std::size_t skippedPrimitives = 0;  ///< Points and lines, once a placement: they have no surface.
  std::size_t skippedFaces = 0;       ///< Faces with vertex indices out of range, once a placement.
};

struct ImportedScene {
  RawScene scene;
  SceneImportReport report;
};

/// One object a mesh instance that has triangles, named after its node (its mesh where the node has
/// no name, the file where neither has). Names are UTF-8 without control characters. Triangles in
/// the order of the file: nodes depth first, parents before children. A face of n corners gives n -
/// 2 triangles. Skins, morphs and animations are not applied. Vertices that are not finite are
/// handed on: Scene::build() drops and counts their triangles. Never throws, never crashes with the
/// file, never leaves a child process behind.
[[nodiscard]] Result<ImportedScene> importScene(const std::string& path,
                                                const SceneImportOptions& options = {});

}  // namespace foretouch
