#include "tools/inputs/motion_file.h"

#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "tools/console.h"
#include "tools/inputs/npz_motion.h"

namespace foretouch::tools {
namespace {

/// A table by its ending, and not a CSV.
bool isNpz(const std::string& path) {
  return clipFormatOf(path) == ClipFormat::JointTable &&
         (path[path.size() - 1] == 'z' || path[path.size() - 1] == 'Z');
}

Result<Done> checkOptions(const MotionRequest& request, ClipFormat format) {
  if (format != ClipFormat::Model && !request.animation.empty()) {
    return Error::in("--animation", ErrorCode::Mismatch,
                     "expected a model (.glb, .gltf, .vrm, .fbx, .dae, .x) as --motion, found " +
                         inQuotes(request.path));
  }
  if (format != ClipFormat::JointTable && !request.robot.empty()) {
    return Error::in("--robot", ErrorCode::Mismatch,
                     "expected a table of joint positions (.csv, .npz) as --motion, found " +
                         inQuotes(request.path));
  }
  const JointTableOptions& table = request.table;
  const bool saysColumns = !table.columns.empty() || table.rateHz || table.quaternion ||
                           table.isInDegrees || table.metresPerUnit;
  if (format != ClipFormat::JointTable && saysColumns) {
    return Error::in("--columns, --row-rate, --quaternion, --angles, --table-scale",
                     ErrorCode::Mismatch,
                     "expected a table of joint positions (.csv, .npz) as --motion, found " +
                         inQuotes(request.path));
  }
  if (format == ClipFormat::JointTable && request.robot.empty()) {
    return Error::in(request.path, ErrorCode::Mismatch,
                     "joint positions are about a robot: expected its URDF (--robot FILE)");
  }
  return Done{};
}

}  // namespace

MotionRequest motionRequestOf(const ClipRequest& request) {
  MotionRequest motion;
  motion.path = request.motionPath;
  motion.scale = request.motionScale;
  motion.up = request.motionUp;
  motion.animation = request.animation;
  motion.robot = request.robotPath;
  motion.packagePaths = request.packagePaths;
  motion.table = request.table;
  motion.rateHz = request.rateHz.value_or(motion.rateHz);
  return motion;
}

ClipFileOptions clipFileOptionsOf(const MotionRequest& request) {
  ClipFileOptions options;
  options.import.scale = request.scale;
  options.import.up = request.up;
  options.animation = request.animation;
  options.rateHz = request.rateHz;
  options.robot = request.robot;
  options.packagePaths = request.packagePaths;
  options.table = request.table;
  return options;
}

Result<Motion> readMotion(const MotionRequest& request) {
  FORETOUCH_CHECK(checkOptions(request, clipFormatOf(request.path)));
  const ClipFileOptions options = clipFileOptionsOf(request);
  if (!isNpz(request.path)) return readClipFile(request.path, options);
  FORETOUCH_TRY(const auto robot, readRobotModel(options));
  FORETOUCH_TRY(auto clip, clipFromNpz(robot, request.path, request.table));
  return Motion{std::move(clip), true, robot.frame};
}

}  // namespace foretouch::tools
