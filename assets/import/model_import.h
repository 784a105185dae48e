// assets/import/model_import.h: rigged models from files: glTF, every other format with bones or
// nodes that assimp reads, URDF, and MJCF where libmujoco is; and a robot from its URDF or MJCF,
// with links as LSS around their collision geometry. Reads them in the same child process, under
// the same limits, as scenes (assets/import/scene_import.h), and checks its output like any other
// untrusted data.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "assets/model/model.h"
#include "assets/model/model_avatar.h"

namespace foretouch {

/// Which of a robot's two descriptions of a link becomes its surface: in MJCF, the geoms that
/// collide, or those that are only seen.
enum class UrdfSurface : std::uint8_t { Collision, Visual };

struct ModelImportOptions {
  SceneImportOptions import;  ///< scale, up, limits and the importer's place, as for scenes.
  UrdfSurface urdfSurface = UrdfSurface::Collision;
  /// A robot: refuses by name what an avatar can do without, with a note, and a robot that moves
  /// by joint coordinates cannot: missing or unreadable meshes, limits the wrong way round, equal
  /// or absent, a floating joint, a mimic of a joint that is not there. For MJCF: docs/robots.md.
  bool isRobot = false;
  bool needsMeshes = false;  ///< A URDF: refuses missing and unreadable meshes, as isRobot does.
  /// Folders to search for package://NAME/..., as FOLDER/NAME/... and FOLDER/...; after them the
  /// URDF's own folder and its parents. For MJCF: folders that its files may lie in, besides its
  /// own.
  std::vector<std::string> packagePaths;
};

/// The model, in metres and +Y up (the turn and the scale apply to the topmost transforms and to
/// lengths, so that the frames of nodes are free of them). Never throws, never crashes with the
/// file, never leaves a child process behind.
[[nodiscard]] Result<Model> importModel(const std::string& path,
                                        const ModelImportOptions& options = {});

struct RobotImportOptions {
  /// `isRobot` is set. Without `import.up`, W is the frame of the URDF's root link,
  /// or MuJoCo's world.
  ModelImportOptions reading;
  ModelAvatarOptions making;
};

struct ImportedRobot {
  ModelRobot made;
  std::vector<std::string> notes;  ///< As Model::notes.
};

/// Errors: as importModel() with `isRobot`, and robotFromModel(), with the file's name.
[[nodiscard]] Result<ImportedRobot> importRobot(const std::string& path,
                                                const RobotImportOptions& options = {});

}  // namespace foretouch
