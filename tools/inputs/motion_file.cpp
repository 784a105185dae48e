#include "tools/inputs/motion_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/model/model_clip.h"
#include "assets/text_file.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

Result<Done> checkOptions(const MotionRequest& request, MotionKind kind) {
  if (kind != MotionKind::Model && !request.animation.empty()) {
    return Error::in("--animation", ErrorCode::Mismatch,
                     "expected a model (.glb, .gltf, .fbx, .dae, .x) as --motion, found " +
                         inQuotes(request.path));
  }
  if (kind != MotionKind::Table && !request.robot.empty()) {
    return Error::in(
        "--robot", ErrorCode::Mismatch,
        "expected a table of joint positions (.csv) as --motion, found " + inQuotes(request.path));
  }
  if (kind == MotionKind::Table && request.robot.empty()) {
    return Error::in(request.path, ErrorCode::Mismatch,
                     "joint positions are about a robot: expected its URDF (--robot FILE)");
  }
  return Done{};
}

Result<Motion> readModel(const MotionRequest& request) {
  ModelImportOptions options;
  options.import.scale = request.scale;
  options.import.up = request.up;
  FORETOUCH_TRY(const auto model, importModel(request.path, options));
  FORETOUCH_TRY(auto clip,
                inFile(clipFromModel(model, {request.animation, request.rateHz}), request.path));
  return Motion{std::move(clip), true, model.frame};
}

Result<Motion> readTable(const MotionRequest& request) {
  FORETOUCH_TRY(const auto text, readWholeFile(request.path, kMaxJointTableBytes));
  ModelImportOptions options;
  options.import.scale = request.scale;
  options.import.up = UpAxis::Z;  // as `avatar urdf` reads it
  options.packagePaths = request.packagePaths;
  FORETOUCH_TRY(const auto robot, importModel(request.robot, options));
  FORETOUCH_TRY(auto clip, inFile(clipFromJointPositions(robot, text, request.path), request.path));
  return Motion{std::move(clip), true, robot.frame};
}

}  // namespace

MotionKind motionKindOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array kModels = {".glb", ".gltf", ".fbx", ".dae", ".x"};
  if (std::find(kModels.begin(), kModels.end(), extension) != kModels.end())
    return MotionKind::Model;
  return extension == ".csv" ? MotionKind::Table : MotionKind::Bvh;
}

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
  const MotionKind kind = motionKindOf(request.path);
  FORETOUCH_CHECK(checkOptions(request, kind));
  if (kind == MotionKind::Model) return readModel(request);
  if (kind == MotionKind::Table) return readTable(request);
  Motion motion;
  static_cast<void>(internal::settleFrame(request.scale, request.up, motion.frame));
  FORETOUCH_TRY(motion.clip, readBvhFile(request.path, BvhOptions{motion.frame.metresPerUnit}));
  return motion;
}

}  // namespace foretouch::tools
