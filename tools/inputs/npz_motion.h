// tools/inputs/npz_motion.h: a robot's motion as arrays of numpy (docs/formats.md).
#pragma once

#include <string>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/model/joint_table.h"
#include "assets/model/model.h"

namespace foretouch::tools {

/// The content of an .npz file as a table; its lines are rows, from 0. Errors name no file.
[[nodiscard]] Result<internal::JointTable> tableFromNpz(std::string bytes,
                                                        const JointTableOptions& options);

/// A file of at most kMaxJointTableBytes as a clip of the robot. Errors name the file, and the row.
[[nodiscard]] Result<Clip> clipFromNpz(const Model& robot, const std::string& path,
                                       const JointTableOptions& options);

}  // namespace foretouch::tools
