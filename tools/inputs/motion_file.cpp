#include "tools/inputs/motion_file.h"

#include "articulated/try.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

Result<Done> checkOptions(const MotionRequest& request, ClipFormat format) {
  if (format != ClipFormat::Model && !request.animation.empty()) {
    return Error::in("--animation", ErrorCode::Mismatch,
                     "expected a model (.glb, .gltf, .fbx, .dae, .x) as --motion, found " +
                         inQuotes(request.path));
  }
  if (format != ClipFormat::JointTable && !request.robot.empty()) {
    return Error::in(
        "--robot", ErrorCode::Mismatch,
        "expected a table of joint positions (.csv) as --motion, found " + inQuotes(request.path));
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
  motion.rateHz = request.rateHz.value_or(motion.rateHz);
  return motion;
}

Result<Motion> readMotion(const MotionRequest& request) {
  FORETOUCH_CHECK(checkOptions(request, clipFormatOf(request.path)));
  ClipFileOptions options;
  options.import.scale = request.scale;
  options.import.up = request.up;
  options.animation = request.animation;
  options.rateHz = request.rateHz;
  options.robot = request.robot;
  options.packagePaths = request.packagePaths;
  return readClipFile(request.path, options);
}

}  // namespace foretouch::tools
