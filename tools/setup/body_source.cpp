#include "tools/setup/body_source.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/text_file.h"
#include "tools/inputs/clip_cut.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"

namespace foretouch::tools {
namespace {

bool isAvatarFile(const std::string& path) {
  return std::filesystem::path(path).extension() == ".json";
}

/// Every format that a reader of models may know, with an animation or without.
bool isModelFile(const std::string& path) {
  if (clipFormatOf(path) == ClipFormat::Model) return true;
  const std::string extension = std::filesystem::path(path).extension().string();
  return clipFormatOf(path) == ClipFormat::Bvh && extension != ".bvh" && extension != ".BVH";
}

Result<Model> readModelOf(const std::string& path, const BodyRequest& request) {
  if (path == request.robotPath) return readRobotModel(clipFileOptionsOf(motionRequestOf(request)));
  ModelImportOptions options;
  options.import.scale = request.motionScale;
  options.import.up = request.motionUp;
  return importModel(path, options);
}

Result<Done> readModelBody(const std::string& path, const BodyRequest& request,
                           const std::string& meshFile, BodySource& source) {
  FORETOUCH_TRY(const auto model, readModelOf(path, request));
  source.frame = model.frame;
  source.isUpright = true;
  const bool hasSurface =
      std::any_of(model.meshes.begin(), model.meshes.end(),
                  [](const ModelMesh& mesh) { return !mesh.triangles.empty(); }) ||
      std::any_of(model.nodes.begin(), model.nodes.end(),
                  [](const ModelNode& node) { return !node.lss.empty(); });
  if (!hasSurface) {  // a motion without a body
    source.notes.push_back(path +
                           ": holds no mesh, so the body is a guess: capsules as thick as a "
                           "person's around its joints; --avatar MODEL takes the file with the "
                           "mesh");
    return Done{};
  }
  ModelAvatarOptions making;
  making.meshFile = meshFile;
  FORETOUCH_TRY(source.ofModel, inFile(avatarFromModel(model, making), path));
  source.avatar = source.ofModel->avatar;
  for (const std::string& note : model.notes) source.notes.push_back(path + ": " + note);
  return Done{};
}

/// A model that holds no animation has no clip, which is not an error here.
Result<Done> readClip(const BodyRequest& request, BodySource& source) {
  if (clipFormatOf(request.motionPath) != ClipFormat::Model && isModelFile(request.motionPath)) {
    source.notes.push_back(request.motionPath +
                           ": its format holds no animation that can be read, so "
                           "the body stands at rest");
    return Done{};
  }
  auto read = readMotion(motionRequestOf(request));
  if (!read.ok()) {
    const bool isStill = read.error().code == ErrorCode::Empty && source.avatar;
    if (!isStill || !request.animation.empty()) return read.error();
    source.notes.push_back(request.motionPath + ": holds no animation, so the body stands at rest");
    return Done{};
  }
  source.frame = read.value().frame;
  source.isUpright = read.value().isUpright;
  for (const std::string& note : read.value().clip.notes) {
    source.notes.push_back(request.motionPath + ": " + note);
  }
  source.clip = std::move(read.value().clip);
  return Done{};
}

}  // namespace

Clip BodySource::clipOrRest() const {
  if (clip) return *clip;
  Clip still;
  still.skeleton = avatar->skeleton();
  still.frameTimeS = 1.0;
  still.frames = {restPose(still.skeleton)};
  const auto joints = static_cast<std::size_t>(still.skeleton.numJoints());
  still.hasTranslation.assign(joints, true);
  still.hasRotation.assign(joints, true);
  still.endSites.resize(joints);
  return still;
}

std::string bodyFileOf(const BodyRequest& request) {
  if (!request.avatarPath.empty()) return request.avatarPath;
  return request.robotPath.empty() ? request.motionPath : request.robotPath;
}

bool makesAvatar(const BodyRequest& request) {
  return !isAvatarFile(request.avatarPath);
}

Result<BodySource> readBody(const BodyRequest& request, const std::string& meshFile) {
  BodySource source;
  if (isAvatarFile(request.avatarPath)) {
    FORETOUCH_TRY(source.avatar, readAvatarFile(request.avatarPath));
  } else {
    const std::string body = bodyFileOf(request);
    if (isModelFile(body)) FORETOUCH_CHECK(readModelBody(body, request, meshFile, source));
  }
  if (!request.motionPath.empty()) FORETOUCH_CHECK(readClip(request, source));
  if (!source.avatar) {
    if (!source.clip) {
      return Error::in(request.avatarPath, ErrorCode::Empty,
                       "expected a model with triangles, or an avatar file (.json)");
    }
    FORETOUCH_TRY(source.avatar, inFile(avatarFromClip(*source.clip), request.motionPath));
  }
  return source;
}

Result<WalkingBody> walkingBody(BodySource& source, const BodyRequest& request) {
  Clip clip = source.clipOrRest();
  const Avatar& avatar = *source.avatar;
  const std::string& path = request.motionPath.empty() ? request.avatarPath : request.motionPath;
  FORETOUCH_CHECK(followByParts(avatar.skeleton(), request.mapPath, path, clip));
  FORETOUCH_TRY(const auto match,
                matchWithMap(avatar.skeleton(), clip.skeleton, request.mapPath, path));
  ClipRequest upright = request;
  upright.placement = {};
  upright.placement.motionUpZ = request.motionUp == UpAxis::Z;
  FORETOUCH_TRY(const auto frames, framesOf(upright, clip, source.isUpright));
  if (const auto note = remarkOnTPose(request, frames, clip)) source.notes.push_back(*note);
  return walkingBody({avatar, clip, match, upright.placement, source.isUpright, path}, frames);
}

}  // namespace foretouch::tools
