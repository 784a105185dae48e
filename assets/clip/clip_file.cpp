#include "assets/clip/clip_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"

namespace foretouch {
namespace {

/// In lower case, with its dot.
std::string endingOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Result<ClipFile> readModel(const std::string& path, const ClipFileOptions& options) {
  ModelImportOptions import;
  import.import = options.import;
  FORETOUCH_TRY(const auto model, importModel(path, import));
  FORETOUCH_TRY(auto clip, inFile(clipFromModel(model, {options.animation, options.rateHz}), path));
  return ClipFile{std::move(clip), true, model.frame};
}

Result<ClipFile> readTable(const std::string& path, const ClipFileOptions& options) {
  if (endingOf(path) != ".csv") {
    return Error::in(path, ErrorCode::Mismatch,
                     "expected a table of joint positions as CSV (.csv)");
  }
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxJointTableBytes));
  FORETOUCH_TRY(const auto robot, readRobotModel(options));
  FORETOUCH_TRY(auto clip, inFile(clipFromJointPositions(robot, text, path, options.table), path));
  return ClipFile{std::move(clip), true, robot.frame};
}

}  // namespace

Result<Model> readRobotModel(const ClipFileOptions& options) {
  ModelImportOptions import;
  import.import = options.import;
  import.import.up = UpAxis::Z;  // as `avatar urdf` reads it
  import.packagePaths = options.packagePaths;
  FORETOUCH_TRY(auto robot, importModel(options.robot, import));
  robot.frame.declared = {1.0, UpAxis::Z, true};  // URDF and MJCF know no other
  return robot;
}

ClipFormat clipFormatOf(const std::string& path) {
  const std::string extension = endingOf(path);
  constexpr std::array kModels = {".glb", ".gltf", ".vrm", ".fbx", ".dae", ".x"};
  if (std::find(kModels.begin(), kModels.end(), extension) != kModels.end()) {
    return ClipFormat::Model;
  }
  return extension == ".csv" || extension == ".npz" ? ClipFormat::JointTable : ClipFormat::Bvh;
}

Result<Clip> sampleRobotFile(const ClipFileOptions& options, std::int32_t samples,
                             std::uint64_t seed) {
  FORETOUCH_TRY(const auto robot, readRobotModel(options));
  return inFile(clipFromSampledJoints(robot, samples, seed), options.robot);
}

Result<ClipFile> readClipFile(const std::string& path, const ClipFileOptions& options) {
  switch (clipFormatOf(path)) {
    case ClipFormat::Model: return readModel(path, options);
    case ClipFormat::JointTable:
      if (options.robot.empty()) {
        return Error::in(path, ErrorCode::Mismatch,
                         "joint positions are about a robot: expected its URDF");
      }
      return readTable(path, options);
    case ClipFormat::Bvh: break;
  }
  ClipFile file;
  static_cast<void>(internal::settleFrame(options.import.scale, options.import.up, file.frame));
  FORETOUCH_TRY(file.clip, readBvhFile(path, BvhOptions{file.frame.metresPerUnit}));
  return file;
}

}  // namespace foretouch
