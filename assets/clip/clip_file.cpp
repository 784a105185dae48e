#include "assets/clip/clip_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/clip/acclaim.h"
#include "assets/clip/webxr_session.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"

namespace foretouch {
namespace {

/// The extension in lower case, with its dot.
std::string endingOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// For MVNX, which has a key for every frame: its own rate, so that each pose is one of the file's.
std::optional<double> recordedRateOf(const std::string& path, const Model& model) {
  if (endingOf(path) != ".mvnx" || model.animations.empty()) return std::nullopt;
  const auto& keys = model.animations.front().tracks.front().positions;
  double shortest = keys[1].timeS - keys[0].timeS;
  for (std::size_t i = 2; i < keys.size(); ++i) {
    shortest = std::min(shortest, keys[i].timeS - keys[i - 1].timeS);
  }
  return 1.0 / shortest;
}

/// The frames between keys of such a file that are not neighbours.
std::vector<ClipGap> gapsBetweenKeys(const Model& model, double rateHz) {
  std::vector<ClipGap> gaps;
  std::int64_t last = -1;
  for (const auto& key : model.animations.front().tracks.front().positions) {
    const std::int64_t frame = std::llround(key.timeS * rateHz);
    if (frame > last + 1) gaps.push_back({last + 1, frame - 1});
    last = frame;
  }
  return gaps;
}

Result<ClipFile> readAcclaim(const std::string& path, const ClipFileOptions& options) {
  std::string skeleton = options.skeleton;
  if (skeleton.empty()) {
    FORETOUCH_TRY(skeleton, skeletonBeside(path));
  }
  FORETOUCH_TRY(const auto asf, readWholeFile(skeleton, kMaxJointTableBytes));
  FORETOUCH_TRY(const auto amc, readWholeFile(path, kMaxBvhFileBytes));
  ClipFile file;
  static_cast<void>(internal::settleFrame(options.import.scale, options.import.up, file.frame));
  FORETOUCH_TRY(file.clip, parseAcclaim(asf, skeleton, amc, path,
                                        {options.import.scale, options.table.rateHz}));
  return file;
}

Result<ClipFile> readWebXr(const std::string& path, const ClipFileOptions& options) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxSessionBytes));
  ClipFile file;
  file.isUpright = true;
  file.frame.declared = {1.0, UpAxis::Y, true};
  FORETOUCH_TRY(file.clip, parseWebXrSession(text, path, options.table.rateHz));
  return file;
}

Result<ClipFile> readModel(const std::string& path, const ClipFileOptions& options) {
  ModelImportOptions import;
  import.import = options.import;
  FORETOUCH_TRY(const auto model, importModel(path, import));
  const auto recordedHz = recordedRateOf(path, model);
  const double rateHz = recordedHz.value_or(options.rateHz);
  FORETOUCH_TRY(auto clip, inFile(clipFromModel(model, {options.animation, rateHz}), path));
  if (recordedHz) clip.gaps = gapsBetweenKeys(model, rateHz);
  // For other models, the code that makes an avatar of them reports the notes.
  if (endingOf(path) == ".mvnx") {
    clip.notes.insert(clip.notes.begin(), model.notes.begin(), model.notes.end());
  }
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
  constexpr std::array kModels = {".glb", ".gltf", ".vrm", ".fbx", ".dae", ".x", ".mvnx"};
  if (std::find(kModels.begin(), kModels.end(), extension) != kModels.end()) {
    return ClipFormat::Model;
  }
  if (extension == ".amc") return ClipFormat::Acclaim;
  if (extension == ".json") return ClipFormat::WebXr;
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
    case ClipFormat::Acclaim: return readAcclaim(path, options);
    case ClipFormat::WebXr: return readWebXr(path, options);
    case ClipFormat::Bvh: break;
  }
  ClipFile file;
  static_cast<void>(internal::settleFrame(options.import.scale, options.import.up, file.frame));
  FORETOUCH_TRY(file.clip, readBvhFile(path, BvhOptions{file.frame.metresPerUnit}));
  return file;
}

}  // namespace foretouch
