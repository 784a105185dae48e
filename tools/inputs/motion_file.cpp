#include "tools/inputs/motion_file.h"

#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "tools/console.h"
#include "tools/inputs/npz_motion.h"
#include "tools/inputs/smpl_motion.h"

namespace foretouch::tools {
namespace {

/// A table by its ending, and not a CSV.
bool isNpz(const std::string& path) {
  return clipFormatOf(path) == ClipFormat::JointTable &&
         (path[path.size() - 1] == 'z' || path[path.size() - 1] == 'Z');
}

Result<Done> checkOptions(const MotionRequest& request, ClipFormat format) {
  if (format != ClipFormat::Model && !request.animation.empty()) {
    return Error::in(
        "--animation", ErrorCode::Mismatch,
        "expected a model (.glb, .gltf, .vrm, .fbx, .dae, .x, .mvnx) as --motion, found " +
            inQuotes(request.path));
  }
  if (format != ClipFormat::JointTable && !request.robot.empty()) {
    return Error::in("--robot", ErrorCode::Mismatch,
                     "expected a table of joint positions (.csv, .npz) as --motion, found " +
                         inQuotes(request.path));
  }
  const JointTableOptions& table = request.table;
  const bool isRated = format == ClipFormat::Acclaim || format == ClipFormat::WebXr;
  const bool saysColumns = !table.columns.empty() || (table.rateHz && !isRated) ||
                           table.quaternion || table.isInDegrees || table.metresPerUnit;
  const bool takesSkeleton = format == ClipFormat::Acclaim || isNpz(request.path);
  if (!request.skeleton.empty() && !takesSkeleton) {
    return Error::in(
        "--skeleton", ErrorCode::Mismatch,
        "expected a motion in AMC or of SMPL (.npz) as --motion, found " + inQuotes(request.path));
  }
  if (!request.skeleton.empty() && !request.robot.empty()) {
    return Error::in(
        "--skeleton", ErrorCode::Mismatch,
        "is of a motion of SMPL, and --robot of joint positions; expected one of them");
  }
  if (format != ClipFormat::JointTable && saysColumns) {
    return Error::in("--columns, --row-rate, --quaternion, --angles, --table-scale",
                     ErrorCode::Mismatch,
                     "expected a table of joint positions (.csv, .npz) as --motion, found " +
                         inQuotes(request.path));
  }
  if (format == ClipFormat::JointTable && request.robot.empty() && request.skeleton.empty()) {
    return Error::in(
        request.path, ErrorCode::Mismatch,
        isNpz(request.path)
            ? "joint positions are about a robot: expected its URDF (--robot FILE); and "
              "a motion of SMPL about a body model: expected it (--skeleton FILE)"
            : "joint positions are about a robot: expected its URDF (--robot FILE)");
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
  motion.skeleton = request.skeletonPath;
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
  options.skeleton = request.skeleton;
  options.packagePaths = request.packagePaths;
  options.table = request.table;
  return options;
}

Result<Motion> readMotion(const MotionRequest& request) {
  FORETOUCH_CHECK(checkOptions(request, clipFormatOf(request.path)));
  const ClipFileOptions options = clipFileOptionsOf(request);
  if (!isNpz(request.path)) return readClipFile(request.path, options);
  if (!request.skeleton.empty()) {
    Motion motion;
    FORETOUCH_TRY(motion.clip, clipFromSmpl(request.path, request.skeleton, request.table.rateHz));
    static_cast<void>(internal::settleFrame({}, request.up, motion.frame));
    return motion;
  }
  FORETOUCH_TRY(const auto robot, readRobotModel(options));
  FORETOUCH_TRY(auto clip, clipFromNpz(robot, request.path, request.table));
  return Motion{std::move(clip), true, robot.frame};
}

}  // namespace foretouch::tools
