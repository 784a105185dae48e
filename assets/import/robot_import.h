// assets/import/robot_import.h: a robot from its URDF: links as LSS around their collision
// geometry, joints by coordinates.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/import/model_import.h"
#include "assets/model/model_robot.h"

namespace foretouch {

struct RobotImportOptions {
  /// `isRobot` is set. Without `import.up`, W is the frame of the URDF's root link.
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
